#!/bin/sh
# A language that nobody speaks, made of the catalogue of the window's words, on stdout: every letter has an accent where
# there is such a letter, every vowel is doubled, and so each sentence is about a third longer. What is filled in stays. A
# window in it shows which words no translator ever saw, and where longer words have no room.
set -eu
cd "$(dirname "$0")/../.."
# The letters of {:.1f}, {:g} and {:02d}, and of the escape \n, are kept aside meanwhile.
export LC_ALL=C.UTF-8
msgen --no-wrap data/languages/jnd.pot |
  sed -e 's/nplurals=INTEGER; plural=EXPRESSION/nplurals=2; plural=n != 1/' -e 's/^"Language: .*/"Language: xx\\n"/' \
    -e '/^"Language: xx/a "X-Language-Name: Pseudo\\n"' \
    -e '/^msgstr/!b' -e 's/^\(msgstr[^"]*\)/\1\x05/' -e 'h' -e 's/\x05.*//' -e 'x' -e 's/.*\x05//' \
    -e ':f' -e 's/\({[^}a-z]*\)f/\1\x01/' -e 'tf' -e ':g' -e 's/\({[^}a-z]*\)g/\1\x02/' -e 'tg' \
    -e ':d' -e 's/\({[^}a-z]*\)d/\1\x03/' -e 'td' -e 's/\\n/\x04/g' \
    -e 's/[AEIOUaeiou]/&&/g' \
    -e 'y/AaCcDdEeGgHhIiJjKkLlNnOoRrSsTtUuWwYyZz/ÁáÇçĐđÉéĞğĤĥÍíĴĵĶķĹĺÑñÖöŘřŠšŤťÜüŴŵÝýŽž/' \
    -e 's/\x01/f/g' -e 's/\x02/g/g' -e 's/\x03/d/g' -e 's/\x04/\\n/g' -e 'H' -e 'x' -e 's/\n//'
