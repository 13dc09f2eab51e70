#!/bin/sh
# The catalogue of the window's words (app/language/words.h), on stdout. Names of files, but no lines and no
# dates: it changes when words do.
set -eu
cd "$(dirname "$0")/../.."
find analysis app core device experiments -name '*.h' -o -name '*.cpp' | LC_ALL=C sort |
  xgettext --files-from=- --language=C++ --from-code=UTF-8 --output=- --add-location=file --width=96 \
    --keyword --keyword=tr:1 --keyword=trn:1,2 --keyword=tr_later:1 --keyword=for_people:1 --keyword=said:1 --keyword=said_later:1 --add-comments=Translators: \
    --package-name=jnd --copyright-holder='the authors of jnd' --msgid-bugs-address=CONTRIBUTING.md |
  sed -e '/^"POT-Creation-Date:/d' -e 's/^#, c-format$//' -e 's/^\(#,.*\), c-format/\1/' \
    -e 's/charset=CHARSET/charset=UTF-8/'
