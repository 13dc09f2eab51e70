#include "core/markers/marker_port.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.h"
#include "core/markers/serial_port.h"
#include "support/pseudo_terminal.h"
#include "support/temporary_folder.h"

namespace jnd::core {
namespace marker_port_test {

using test_support::PseudoTerminal;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string refusal_of(const WantedMarkers& wanted) {
  try {
    (void)open_marker_port(wanted);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(MarkerPort, ABytePortSendsTheCodeAndZeroAtItsEnd) {
  const PseudoTerminal terminal;
  const auto port = open_marker_port({.port = terminal.path()});
  port->set(10);  // A line feed, a carriage return, XOFF and a delete must pass as plain bytes.
  port->clear();
  port->set(13);
  port->set(19);
  port->set(127);
  port->set(255);
  EXPECT_THAT(terminal.received(6), ElementsAre(10, 0, 13, 19, 127, 255));
}

TEST(MarkerPort, NobodyElseOpensItMeanwhile) {
  const PseudoTerminal terminal;
  const auto port = open_marker_port({.port = terminal.path()});
  if (::geteuid() == 0) GTEST_SKIP() << "root opens what is exclusive";
  EXPECT_THAT(refusal_of({.port = terminal.path()}),
              HasSubstr("close the program that has it"));
}

TEST(MarkerPort, APortThatIsNotThereSaysWhatToDo) {
  EXPECT_THAT(refusal_of({.port = "/dev/ttyUSB_none"}),
              HasSubstr("/dev/ttyUSB_none: expected a port that can be opened, found `No such "
                        "file or directory`; look whether it is plugged in"));
  EXPECT_THAT(refusal_of({.port = "/dev/null"}), HasSubstr("expected a serial port"));
  const PseudoTerminal terminal;
  EXPECT_THAT(refusal_of({.port = terminal.path(), .baud = 12345}),
              HasSubstr("expected 9600, 19200"));
}

TEST(MarkerPort, LinesNeedAPortThatHasThem) {
  const PseudoTerminal terminal;
  EXPECT_THAT(refusal_of({.port = terminal.path(), .serial = SerialMarker::kRts}),
              HasSubstr("expected a serial port with the lines RTS and DTR"));
}

TEST(MarkerPort, AParallelPortIsKnownByItsName) {
  EXPECT_EQ(way_of({.port = "/dev/parport0"}), "parallel");
  EXPECT_EQ(way_of({.port = "/dev/ttyUSB0"}), "bytes");
  EXPECT_EQ(way_of({.port = "/dev/ttyUSB0", .serial = SerialMarker::kDtr}), "dtr");
  const test_support::TemporaryFolder folder;
  const std::string file = (folder.path() / "parport0").string();
  std::ofstream(file) << "none";
  EXPECT_THAT(refusal_of({.port = file}), HasSubstr("expected a parallel port"));
}

TEST(MarkerPort, ACableThatIsPulledIsAnError) {
  PseudoTerminal terminal;
  const auto port = open_marker_port({.port = terminal.path()});
  terminal.unplug();
  EXPECT_THROW(port->set(1), Error);
}

}  // namespace marker_port_test
}  // namespace jnd::core
