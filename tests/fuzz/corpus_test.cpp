#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "support/places.h"

extern "C" {
int study_fuzz_input(const std::uint8_t* data, std::size_t size);
int csv_fuzz_input(const std::uint8_t* data, std::size_t size);
int event_fuzz_input(const std::uint8_t* data, std::size_t size);
int recording_fuzz_input(const std::uint8_t* data, std::size_t size);
int laboratory_fuzz_input(const std::uint8_t* data, std::size_t size);
int datagram_fuzz_input(const std::uint8_t* data, std::size_t size);
int force_map_fuzz_input(const std::uint8_t* data, std::size_t size);
int device_profile_fuzz_input(const std::uint8_t* data, std::size_t size);
int formula_fuzz_input(const std::uint8_t* data, std::size_t size);
int stream_fuzz_input(const std::uint8_t* data, std::size_t size);
}

namespace corpus_test {

namespace fs = std::filesystem;
using Input = int (*)(const std::uint8_t*, std::size_t);

/// Feeds a fuzz target with every file of a folder, which holds seeds and earlier findings.
void expect_sound(Input input, const std::string& folder) {
  int num_files = 0;
  for (const auto& entry :
       fs::directory_iterator(jnd::test_support::source_folder() / folder)) {
    std::ifstream stream(entry.path(), std::ios::binary);
    const std::vector<char> letters{std::istreambuf_iterator<char>(stream), {}};
    const std::vector<std::uint8_t> bytes(letters.begin(), letters.end());
    ++num_files;
    try {
      EXPECT_EQ(input(bytes.data(), bytes.size()), 0) << entry.path();
    } catch (const std::exception& error) {
      ADD_FAILURE() << entry.path() << ": " << error.what();
    }
  }
  EXPECT_GT(num_files, 0) << folder;
}

TEST(FuzzCorpus, StudiesAreReadOrRefusedWithASentence) {
  expect_sound(study_fuzz_input, "tests/fuzz/corpus/study");
  expect_sound(study_fuzz_input, "protocols");
}

TEST(FuzzCorpus, TablesAreReadOrRefusedWithASentence) {
  expect_sound(csv_fuzz_input, "tests/fuzz/corpus/csv");
}

TEST(FuzzCorpus, EventsAreReadAndFoldedOrRefusedWithASentence) {
  expect_sound(event_fuzz_input, "tests/fuzz/corpus/event");
}

TEST(FuzzCorpus, ChunksOfSamplesAreReadOrRefusedWithASentence) {
  expect_sound(recording_fuzz_input, "tests/fuzz/corpus/recording");
}

TEST(FuzzCorpus, ForceMapsAreReadOrRefusedWithASentence) {
  expect_sound(force_map_fuzz_input, "tests/fuzz/corpus/force_map");
}

TEST(FuzzCorpus, DatagramsAreReadOrRefused) {
  expect_sound(datagram_fuzz_input, "tests/fuzz/corpus/datagram");
}

TEST(FuzzCorpus, LaboratoriesAreReadOrRefusedWithASentence) {
  expect_sound(laboratory_fuzz_input, "tests/fuzz/corpus/laboratory");
  expect_sound(laboratory_fuzz_input, "data/laboratories");
}

TEST(FuzzCorpus, StreamsOfOthersAreReadOrRefusedWithASentence) {
  expect_sound(stream_fuzz_input, "tests/fuzz/corpus/stream");
}

TEST(FuzzCorpus, DeviceProfilesAreReadOrRefusedWithASentence) {
  expect_sound(device_profile_fuzz_input, "tests/fuzz/corpus/device_profile");
  expect_sound(device_profile_fuzz_input, "tests/experiments/device_profile/broken");
}

TEST(FuzzCorpus, FormulasAreReadOrRefusedWithASentence) {
  expect_sound(formula_fuzz_input, "tests/fuzz/corpus/formula");
}

}  // namespace corpus_test
