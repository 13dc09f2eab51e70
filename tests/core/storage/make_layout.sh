#!/usr/bin/env bash
# ./make_layout.sh N: makes layout_N/study.sqlite from that of layout N - 1, as a program of that
# layout would have left it: it brings the study up to date, as today's does, and goes on with it.
# What it adds is layout_N/rows.sql.
set -euo pipefail
cd "$(dirname "$0")"
layout=$1
study=layout_$layout/study.sqlite
[[ ! -e $study ]] || { echo "$study: expected none, for a study of a layout is never changed" >&2; exit 1; }
cp "layout_$((layout - 1))/study.sqlite" "$study"
sqlite3 -bail "$study" <<SQL
PRAGMA foreign_keys = ON;
BEGIN;
.read $(echo ../../../data/database/"$layout"_*.sql)
INSERT INTO study_format VALUES ($layout, 'jnd');
.read layout_$layout/rows.sql
COMMIT;
PRAGMA integrity_check;
PRAGMA foreign_key_check;
SQL
