#!/usr/bin/env bash
# tests/package/bare_debian.sh PACKAGE.deb [KEPT]: as root, makes a bare Debian 12 in a folder, from where this machine gets its packages,
# installs the package there with apt, and does what somebody does in the first minutes, without a compiler:
# both studies of the thesis, the window on a display, a manual page, completion. Prints how long each takes. The bare system, packages that
# are downloaded, a picture of the window and all output are kept in KEPT (build/bare_debian).
set -euo pipefail
if [ "$(id -u)" -ne 0 ]; then
  echo "bare_debian: expected root, who alone makes a system in a folder; run it as root" >&2
  exit 3
fi
package=$(realpath "${1:?expected a package, as ./dev package makes it}")
mkdir -p "${2:-$(dirname "$0")/../../build/bare_debian}"
kept=$(cd "${2:-$(dirname "$0")/../../build/bare_debian}" && pwd)
mkdir -p "$kept/archives"
release=bookworm

# The paragraphs and lines of this machine's sources that are about this release alone.
sources() {
  local file
  for file in /etc/apt/sources.list.d/*.sources; do
    [ -f "$file" ] || continue
    awk -v RS= -v ORS='\n\n' "/(^|\n)Suites:[^\n]* $release( |\n|\$)/ || /(^|\n)Suites:[^\n]* $release-(security|updates)/" "$file"
  done
}
one_line_sources() {
  cat /etc/apt/sources.list /etc/apt/sources.list.d/*.list 2>/dev/null |
    grep -E "^deb .* $release(-updates|-security)? " || true
}

# In namespaces of its own, so that nothing stays mounted and nothing goes on running.
if [ -z "${JND_BARE_INSIDE:-}" ]; then
  exec env JND_BARE_INSIDE=1 unshare --mount --pid --fork --kill-child --mount-proc "$0" "$package" "$kept"
fi

root=$(mktemp -d)
trap 'umount -R "$root/dev" "$root/proc" 2>/dev/null || true; rm -rf --one-file-system "$root"' EXIT
now_ms() { date +%s%3N; }
began=$(now_ms)
# lap WORDS: how long it is since the last lap.
lap() {
  local now
  now=$(now_ms)
  printf '%-44s %6d.%d s\n' "$1" $(((now - began) / 1000)) $(((now - began) % 1000 / 100))
  began=$(now_ms)
}
fail() {
  echo "bare_debian: $1" >&2
  exit 1
}

sources >"$kept/sources"
list=jnd.sources
if ! [ -s "$kept/sources" ]; then
  one_line_sources >"$kept/sources"
  list=jnd.list
fi
# The bare system is made once; packages in it are brought up to date by what follows.
if ! [ -f "$kept/bare.tar" ]; then
  mmdebstrap --quiet --variant=minbase --mode=root "$release" "$kept/bare.unfinished.tar" "$kept/sources" 2>"$kept/mmdebstrap.log" ||
    { cat "$kept/mmdebstrap.log" >&2; exit 3; }
  mv "$kept/bare.unfinished.tar" "$kept/bare.tar"
fi
tar -xf "$kept/bare.tar" -C "$root" --numeric-owner
lap "a bare $release"

# As this machine reaches its packages.
rm -f "$root"/etc/apt/sources.list "$root"/etc/apt/sources.list.d/*
cp "$kept/sources" "$root/etc/apt/sources.list.d/$list"
cp /etc/apt/apt.conf.d/* "$root/etc/apt/apt.conf.d/" 2>/dev/null || true
rm -f "$root"/etc/apt/apt.conf.d/docker-* "$root"/etc/apt/apt.conf.d/*packagekit* "$root"/etc/apt/apt.conf.d/*appstream*
cp -L /etc/resolv.conf /etc/hosts "$root/etc/" 2>/dev/null || true
mkdir -p "$root/proc" "$root/dev"
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
mount --make-rslave "$root/dev"
printf '#!/bin/sh\nexit 101\n' >"$root/usr/sbin/policy-rc.d"
chmod 755 "$root/usr/sbin/policy-rc.d"
inside() { env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive /usr/sbin/chroot "$root" "$@"; }
as_anna() { env -i PATH=/usr/bin:/bin HOME=/home/anna LANG=C.UTF-8 /usr/sbin/chroot --userspec=anna:anna "$root" sh -c "cd && $1"; }

cp -n "$kept"/archives/*.deb "$root/var/cache/apt/archives/" 2>/dev/null || true
cp "$package" "$root/root/"
name=$(basename "$package")
inside apt-get -qq update >"$kept/apt.log" 2>&1 || fail "apt-get update failed; see $kept/apt.log"
tools=(man-db bash-completion xvfb xauth imagemagick)
lap "lists of packages"
inside apt-get install -y -qq --download-only "/root/$name" >>"$kept/apt.log" 2>&1 || fail "no download; see $kept/apt.log"
lap "download of what the package depends on"
inside apt-get install -y -qq "/root/$name" >>"$kept/apt.log" 2>&1 || fail "no installation; see $kept/apt.log"
lap "apt install ./$name"
installed=$began
inside getent group jnd >/dev/null || fail "expected a group jnd, found none"
for compiler in cc gcc g++ clang cmake make ninja; do
  ! inside sh -c "command -v $compiler" >/dev/null || fail "expected no compiler in a bare system, found $compiler"
done

inside useradd --create-home --shell /bin/bash anna
as_anna 'jnd demo --fast --out first_look' >"$kept/demo.txt" 2>&1 || { tail "$kept/demo.txt" >&2; fail "the demo failed"; }
grep -q 'every answer is in first_look' "$kept/demo.txt" || fail "the demo did not end as told"
lap "jnd demo --fast"
as_anna 'jnd results first_look/viscosity_discrimination.study' >"$kept/results.txt" || fail "no results"
as_anna 'jnd report first_look/viscosity_discrimination.study --out report' >>"$kept/results.txt" || fail "no report"
lap "jnd results, jnd report"
as_anna 'jnd devices' | grep -q force_dimension || fail "expected the driver force_dimension among the devices"
as_anna 'test -s /usr/share/jnd/languages/de/LC_MESSAGES/jnd.mo' || fail "expected the window's words in German, found none"
page=$(as_anna 'jnd manual run_a_session') || fail "expected the manual beside the program, found none"
[ "$page" = /usr/share/doc/jnd/html/docs/how-to/run_a_session.html ] || fail "expected the page of the installed site, found $page"
as_anna 'jnd doctor --fix --dry-run' >"$kept/doctor.txt" || fail "doctor --fix --dry-run failed"
inside jnd doctor --fix --user anna >>"$kept/doctor.txt" 2>&1 || fail "doctor --fix failed; see $kept/doctor.txt"
inside id -nG anna | grep -qw jnd || fail "expected anna in the group jnd after doctor --fix"
lap "jnd doctor --fix"

inside apt-get install -y -qq --no-install-recommends "${tools[@]}" >>"$kept/apt.log" 2>&1 || fail "no tools; see $kept/apt.log"
cp -n "$root"/var/cache/apt/archives/*.deb "$kept/archives/" 2>/dev/null || true
rm -f "$kept/archives/$name"
lap "tools that look at it: ${tools[*]}"
as_anna 'xvfb-run -a -s "-screen 0 1600x1000x24" sh -c "
    jnd >window.txt 2>&1 & window=\$!
    sleep 4
    import -window root window.png
    kill \$window
    wait \$window || true"' >"$kept/window.txt" 2>&1 || { cat "$kept/window.txt" >&2; fail "the window did not open"; }
cp "$root/home/anna/window.png" "$kept/window.png"
colours=$(inside identify -format '%k' /home/anna/window.png)
[ "$colours" -gt 50 ] || { cat "$root/home/anna/window.txt" >&2; fail "expected a window with letters, found $colours colours"; }
lap "the window, seen for 4 s ($colours colours)"
as_anna 'man jnd-run | col -b 2>/dev/null || man jnd-run' >"$kept/man.txt" 2>&1
grep -q -- '--participant' "$kept/man.txt" || fail "expected --participant on the page jnd-run"
lap "man jnd-run ($(wc -l <"$kept/man.txt") lines)"
completed=$(as_anna "bash -c '. /usr/share/bash-completion/bash_completion; _completion_loader jnd; COMP_WORDS=(jnd fit psy); COMP_CWORD=2
    _jnd; printf %s \"\${COMPREPLY[*]}\"'")
[ "$completed" = psychometric ] || fail "expected psychometric, found \`$completed\`"
lap "completion of jnd fit psy: $completed"

inside apt-get purge -y -qq jnd >>"$kept/apt.log" 2>&1 || fail "no removal; see $kept/apt.log"
[ -f "$root/home/anna/first_look/viscosity_discrimination.study/study.sqlite" ] || fail "the removal took data away"
inside sh -c '! command -v jnd && ! test -e /usr/share/jnd && ! test -e /etc/security/limits.d/jnd.conf' >/dev/null ||
  fail "expected nothing left of the package"
lap "apt purge jnd; data and group stay"
