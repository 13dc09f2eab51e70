#pragma once

namespace jnd::experiments {

/// The text above the tables of the reference: how a study is written by hand.
inline constexpr const char* kReferenceIntroduction = R"md(# Studies

This page is made by `jnd schema --markdown` from the tables that the program reads studies with. Do not edit it.

A study is one text file in JSON. It says everything that happens in a session, stage by stage: what the experimenter does
and says, what the participant reads, feels and is asked. The program needs nothing else to run the study, to plan it, to
simulate it and to analyse it. A study takes nothing from other files.

## From an idea to data

1. `jnd new my_study` writes `my_study.json`, a small study that works, with comments, and `study.schema.json` beside it.
   Open the folder in an editor. VS Code and others read the schema (the key `$schema` names it) and then complete keys,
   explain them and underline what is wrong; in VS Code press Ctrl Space where something is to be inserted.
2. Change it. `jnd validate my_study.json` tells every problem at once, each with line and column:
   `my_study.json:14:45: /stages/1/repetitons: expected a key of ..., found the unknown key ...; did you mean ...?`
   What stands between the slashes is the way to the place: the second entry (counting from 0) of the list `stages`, its key
   `repetitons`. `jnd validate my_study.json --device NAME` also says which stimuli that device cannot render.
3. `jnd plan my_study.json` shows what the participants would get, in which order, how long it takes, and every stimulus
   against the limits of the device.
4. `jnd simulate my_study.json --participants 8 --study try.study`, then `jnd results try.study`: simulated participants
   do the study, and you see which results it gives before anybody comes.
5. `jnd run my_study.json --study my_study.study --participant P01` runs it. The first session puts a copy of the study file
   into the folder `my_study.study`; a changed file wants a new folder.

To begin from a study that is shipped: `jnd new my_study --from short_tour`.

How precisely a Weber fraction is known after so many trials, by constant stimuli, staircases and QUEST+:
[what trials are worth](../data/reference/precision/README.md).

## How the file is written

- Objects stand in braces and hold keys with values: `{"name": "rest", "duration_s": 60}`. Lists stand in brackets:
  `[2, 4, 8]`. Entries are parted by commas, with none after the last. Words stand in double quotes; numbers, `true` and
  `false` do not. Decimals have a point: `0.5`. A whole number is written without one: `3`, not `3.0`.
- Keys may come in any order, each once. A key that is not known is a problem, so that a misspelt one cannot be overlooked.
- The unit is the end of the key: `duration_s` is in seconds, `viscosity_pa_s` in pascal seconds (1 Pa s = 1000 mPa s = 1000 cP).
- Words for people are given in each language of the study: `{"en": "Rest.", "de": "Pause."}`. The key `languages` lists
  the codes; a text that lacks one of them is a problem.
- Names are for files and data: lower-case letters, digits and `_`, at most 64 of them.
- Every object may have a `comment`, a text without effect. JSON has no other comments.
- The file is saved as UTF-8 and at most 4 MiB large.

## Who gets what

Stages run from the first to the last. What differs between participants:

- A stage `counterbalance` holds `arms`, each with stages of its own. With `"method": "order"` everybody runs all arms, in
  different orders; with `"method": "one_of"` everybody runs one of them. Several counterbalances are crossed. Each new
  participant gets the combination (the cell) with the fewest completed sessions. One counterbalance cannot stand in
  another.
- `"stratify_by": "handedness"` in a counterbalance balances it among the left-handed and among the right-handed, each by
  themselves. `participant_fields` says what has to be known for that before a session: the window asks for it, `jnd run`
  takes `--field handedness=left`. What a questionnaire asks comes too late for that.
- Any other stage may have `"only_for": {"priming": "primed"}`: it runs only for those who are in the arm `primed` of the
  `one_of` counterbalance `priming`, wherever that one stands.

The order of the stimuli within a block is drawn anew for every participant; the key `order` of a block says what it must
keep to. Where it asks for a square, the rows of the square are one more thing that cells consist of.

## How to read the tables

Under *default*, `required` is a key that has to be there, `optional` one that may be left out; anything else is what
counts where the key is absent. Ranges: `> 0` is larger than 0, `>= 0` may be 0. Of a list, unit and range are those of
each of its numbers.
)md";

}  // namespace jnd::experiments
