"""Commanded and delivered Weber fractions on simulated devices with damping of their own.

Each device is commissioned, study 2 of the thesis is simulated on it with the profile that came
of it, and its results are computed by intensities as commanded and as delivered. Writes
delivered.csv, delivered.gp and delivered.svg beside itself and the table in Markdown to stdout;
a minute. From the root of the tree, after `./dev build`:

    python3 data/reference/delivered/delivered.py build/jnd

Not run by the tests. Needs gnuplot.
"""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
DAMPINGS_N_S_PER_M = ["0", "2.4", "4.8"]
BLOCKS = {"group_d": "thin", "group_e": "thick"}
PEOPLE = "13"
SEED = "1"
# A box of 1.8 m, so that the profile's space, which reaches 50 cm beyond it, holds the widest
# strokes of simulated people on a device without damping.
MARKS = "".join(f"{x},{y},{z}\n" for x in (-0.9, 0.9) for y in (-0.9, 0.9) for z in (-0.9, 0.9))

GNUPLOT = """# Commanded and delivered Weber fractions (SIMULATED data)
# Draw it here with: gnuplot delivered.gp
set terminal svg size 634,300 font 'Inter,12' noenhanced background 'white'
set output 'delivered.svg'
set encoding utf8
set datafile separator comma
set datafile columnheaders
set border 3 lc rgb '#333333'
set tics nomirror out scale 0.6
set bars 0.6
set logscale y
set yrange [0.12:2.2]
set ytics (0.2, 0.3, 0.5, 1, 2)
set xrange [-1:5.8]
set xtics (0, 2.4, 4.8)
set label 99 'SIMULATED' at screen 0.995,0.965 right font 'Inter,10' tc rgb '#777777'
set multiplot layout 1,2
do for [block in 'group_d group_e'] {
  set title (block eq 'group_d' ? 'Thin fluid (group D)' : 'Thick fluid (group E)') font 'Inter,12'
  set xlabel 'Own damping of the device [N s/m]'
  set ylabel (block eq 'group_d' ? 'Weber fraction of the group' : '')
  if (block eq 'group_d') { set key top left reverse Left samplen 1 font 'Inter,10' } else { unset key }
  plot 'delivered.csv' using (strcol('block') eq block ? column('damping_n_s_per_m')-0.2 : NaN):'commanded':'commanded_low':'commanded_high' with yerrorbars lc rgb '#0072B2' pt 7 ps 0.8 title 'commanded', \\
    '' using (strcol('block') eq block ? column('damping_n_s_per_m')+0.1 : NaN):'delivered':'delivered_low':'delivered_high' with yerrorbars lc rgb '#D55E00' pt 4 ps 0.8 title 'delivered', \\
    '' using (strcol('block') eq block ? column('damping_n_s_per_m')+0.35 : NaN):'delivered':'device_low':'device_high' with yerrorbars lc rgb '#000000' lw 1.5 pt 13 ps 0.7 title 'of the device'
  unset label 99
}
unset multiplot
unset output
"""


def run(program, folder, *words):
    return subprocess.run([program, *words], cwd=folder, check=True, capture_output=True,
                          text=True).stdout


def estimates(text):
    return {one["name"]: one for section in json.loads(text)["sections"]
            for one in section["estimates"]}


def rows_of(program, folder, damping):
    device = f"twin:gain=0.9,damping_n_s_per_m={damping},friction_n=0.2"
    (pathlib.Path(folder) / "marks.csv").write_text(MARKS, encoding="utf-8")
    profile = json.loads(run(program, folder, "commission", device, "--marks", "marks.csv",
                             "--record", f"{damping}.jsonl", "--out", damping,
                             "--json"))["profile"]
    study = f"{damping}.study"
    run(program, folder, "simulate", "viscosity_discrimination", "--participants", PEOPLE,
        "--study", study, "--device", device, "--profile", profile, "--seed", SEED, "--fast")
    commanded = estimates(run(program, folder, "results", study, "--json"))
    delivered = estimates(run(program, folder, "results", study, "--delivered", "--json"))
    for block in BLOCKS:
        name = block + ".weber_fraction"
        yield {"damping_n_s_per_m": damping, "block": block,
               "commanded": commanded[name]["value"],
               "commanded_low": commanded[name]["ci95"][0],
               "commanded_high": commanded[name]["ci95"][1],
               "delivered": delivered[name]["value"],
               "delivered_low": delivered[name]["ci95"][0],
               "delivered_high": delivered[name]["ci95"][1],
               "device_low": delivered[name]["ci95_device"][0],
               "device_high": delivered[name]["ci95_device"][1], "simulated": 1}


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as folder:
        rows = [row for damping in DAMPINGS_N_S_PER_M for row in rows_of(program, folder, damping)]
    with open(HERE / "delivered.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    (HERE / "delivered.gp").write_text(GNUPLOT, encoding="utf-8")
    subprocess.run(["gnuplot", "delivered.gp"], cwd=HERE, check=True)
    print("| own damping | block | commanded | delivered | of the device |")
    print("| --- | --- | --- | --- | --- |")
    for row in rows:
        damping = f"{row['damping_n_s_per_m']} N s/m" if row["block"] == "group_d" else ""
        print(f"| {damping} | {row['block']} ({BLOCKS[row['block']]}) "
              f"| {row['commanded']:.3f} [{row['commanded_low']:.3f}, {row['commanded_high']:.3f}] "
              f"| {row['delivered']:.3f} [{row['delivered_low']:.3f}, {row['delivered_high']:.3f}] "
              f"| {row['device_low']:.3f} to {row['device_high']:.3f} |")


if __name__ == "__main__":
    main()
