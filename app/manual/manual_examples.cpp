#include <algorithm>
#include <array>
#include <string_view>

#include "app/manual/manual_page.h"

namespace jnd::app {
namespace {

struct ExampleRow {
  std::string_view command, call, meaning;
};

// A test compares each call with the tree: its command, and every option in it.
constexpr std::array kExampleRows = {
    ExampleRow{"jnd", "jnd", "opens the window"},
    ExampleRow{"jnd", "jnd demo --fast", "runs both studies of the thesis in a few seconds"},
    ExampleRow{"jnd", "jnd doctor", "tells what this machine lacks"},
    ExampleRow{"jnd demo", "jnd demo --fast --out first_look",
               "two studies of 13 simulated participants each, in the folder first_look"},
    ExampleRow{"jnd demo", "jnd demo --device exoskeleton",
               "the same on the whole simulated robot; some twenty minutes"},
    ExampleRow{"jnd validate", "jnd validate my_study.json",
               "every problem at its line, and levels to look at again"},
    ExampleRow{"jnd validate", "jnd validate my_study.json --device exoskeleton",
               "also every stimulus that the device cannot render"},
    ExampleRow{"jnd schema", "jnd schema --markdown", "every key of a study file, to read"},
    ExampleRow{"jnd new", "jnd new my_study --from viscosity_staircase",
               "writes my_study.json, which begins as the shipped study"},
    ExampleRow{"jnd plan", "jnd plan my_study.json --participants 24",
               "orders, balance and length for 24 participants"},
    ExampleRow{"jnd power", "jnd power my_study.json --participants 6,8..40 --runs 1000",
               "how many participants it takes"},
    ExampleRow{"jnd power-merge", "jnd power-merge shard-*.json --out my_power",
               "joins what several machines have computed"},
    ExampleRow{"jnd preregister",
               "jnd preregister my_study.json --participants 24 --study my_study.study",
               "writes the plan and keeps it with the data"},
    ExampleRow{"jnd sound", "jnd sound", "outputs of this machine, and which are calibrated"},
    ExampleRow{"jnd sound", "jnd sound --play noise --level-dbfs -50 --seconds 60",
               "a minute of pink noise for the meter, and how many gaps it had"},
    ExampleRow{"jnd run", "jnd run my_study.json --study my_study.study --participant P01",
               "opens the window at the preparation of this session"},
    ExampleRow{"jnd run", "jnd run short_tour --study tour.study --participant P01 --headless",
               "one session without a window, the participant simulated"},
    ExampleRow{"jnd simulate",
               "jnd simulate my_study.json --participants 8 --study my_study.study",
               "eight whole sessions, faster than real time"},
    ExampleRow{"jnd resume", "jnd resume my_study.study",
               "goes on with the trial that was interrupted"},
    ExampleRow{"jnd look", "jnd look my_study.study", "says go on or stop, and nothing else"},
    ExampleRow{"jnd verify", "jnd verify my_study.study",
               "proves that every answer and sample is there"},
    ExampleRow{"jnd backup", "jnd backup my_study.study --to /media/disk/my_study",
               "copies what is new and reads it back"},
    ExampleRow{"jnd restore", "jnd restore /media/disk/my_study --to my_study.study",
               "a study again, made of its backup"},
    ExampleRow{
        "jnd exclude",
        "jnd exclude my_study.study --participant P01 --trial 3 4 --reason \"phone rang\"",
        "two trials are out of the results, not of the data"},
    ExampleRow{"jnd unblind", "jnd unblind my_study.study --reason \"data are complete\"",
               "the levels of a double-blind study can be seen from now on"},
    ExampleRow{"jnd withdraw", "jnd withdraw my_study.study --participant P01",
               "deletes a person for good, in known backups too"},
    ExampleRow{"jnd adverse-event",
               "jnd adverse-event my_study.study --session 1 --text \"a pinched finger\"",
               "is kept for good; without --text it lists them"},
    ExampleRow{"jnd results", "jnd results my_study.study --json",
               "every fit and comparison as one JSON document"},
    ExampleRow{"jnd report", "jnd report my_study.study --out my_report",
               "what a paper needs, with every figure"},
    ExampleRow{"jnd export", "jnd export csv my_study.study --out my_tables",
               "tidy tables with a codebook"},
    ExampleRow{"jnd export", "jnd export hdf5 my_study.study --out my_samples",
               "every sample of the loop"},
    ExampleRow{"jnd fit", "jnd fit weber --csv answers.csv --reference 10",
               "the Weber fraction of a table of answers"},
    ExampleRow{"jnd fit psychometric",
               "jnd fit psychometric --csv trials.csv --intensity level --yes correct --task "
               "mafc:2",
               "the curve of a forced choice between two"},
    ExampleRow{"jnd fit weber",
               "jnd fit weber --csv answers.csv --reference 10 --group-by participant",
               "one fit for each participant"},
    ExampleRow{"jnd fit hierarchical",
               "jnd fit hierarchical --csv everybody.csv --reference 10",
               "the median person, from everybody's answers"},
    ExampleRow{"jnd fit effects", "jnd fit effects --csv answers.csv --reference 10",
               "whether people answered otherwise later than at first"},
    ExampleRow{
        "jnd fit glmm",
        "jnd fit glmm --csv trials.csv --yes answer --fixed \"u * condition\" --random \"1 "
        "+ u | participant\" --stimulus u",
        "a mixed model by formula"},
    ExampleRow{"jnd fit glmm",
               "jnd fit glmm --csv trials.csv --yes answer --fixed u --random \"1 + u || "
               "participant\" --group-by block",
               "the linear model of fit hierarchical, a fit for each block"},
    ExampleRow{"jnd fit detection",
               "jnd fit detection --csv answers.csv --intensity level --yes said_yes",
               "catch trials are those at intensity 0"},
    ExampleRow{"jnd fit same-different",
               "jnd fit same-different --csv answers.csv --yes different --reference 10",
               "every pair has the stimulus 10"},
    ExampleRow{"jnd fit power", "jnd fit power --csv magnitudes.csv",
               "columns intensity and magnitude"},
    ExampleRow{"jnd fit power", "jnd fit power --csv magnitudes.csv --participant participant",
               "the law of a group of people, and everybody's exponent"},
    ExampleRow{"jnd fit between",
               "jnd fit between --k1 0.6663 --a1 0.6386 --k2 0.3761 --a2 1.206 --intensities "
               "0.5,1,2",
               "the power law between an estimation and a production"},
    ExampleRow{"jnd compare", "jnd compare --csv pairs.csv --test paired",
               "columns a and b, a row for each person"},
    ExampleRow{"jnd force", "jnd force water --velocity-m-per-s 1,0,0",
               "the force of water on a hand at 1 m/s, point by point"},
    ExampleRow{"jnd loop", "jnd loop --seconds 10", "how punctual this machine is"},
    ExampleRow{"jnd devices", "jnd devices", "what can be given to --device"},
    ExampleRow{"jnd device-check", "jnd device-check plugin:./my_driver.so",
               "does a driver of yours keep the rules?"},
    ExampleRow{"jnd commission", "jnd commission twin:seed=7",
               "measures a simulated device with the faults of real ones"},
    ExampleRow{"jnd doctor", "jnd doctor", "tells what is lacking, and changes nothing"},
    ExampleRow{"jnd doctor", "sudo jnd doctor --fix",
               "makes the group jnd, joins whoever called sudo to it and gives it its rights"},
    ExampleRow{"jnd doctor", "jnd doctor --fix --dry-run",
               "prints the commands that it would run"},
    ExampleRow{"jnd stability", "jnd stability --device exoskeleton",
               "the thickest fluid and the stiffest plane that stay stable"},
    ExampleRow{"jnd characterize", "jnd characterize --device exoskeleton",
               "break-away forces, errors of the sensors, viscosity in free space"},
    ExampleRow{"jnd device-simulator", "jnd device-simulator --port 4700",
               "serves the simulated exoskeleton to other programs"},
    ExampleRow{"jnd device-server", "jnd device-server --device plugin:./my_driver.so",
               "serves a driver of yours to a window on another machine"},
    ExampleRow{"jnd device-key", "jnd device-key laboratory",
               "draws the key that both machines get a copy of"},
    ExampleRow{"jnd manual", "jnd manual run_a_session --open",
               "opens the page about sessions, in the browser where the site is there"},
    ExampleRow{"jnd manual", "jnd manual --list", "the names of all pages"},
    ExampleRow{"jnd completions", "source <(jnd completions bash)",
               "completes commands and options in this shell"},
};

}  // namespace

std::vector<ManualExample> manual_examples(const std::string& name) {
  std::vector<ManualExample> examples;
  for (const ExampleRow& row : kExampleRows) {
    if (row.command == name) {
      examples.push_back({std::string(row.call), std::string(row.meaning)});
    }
  }
  return examples;
}

}  // namespace jnd::app
