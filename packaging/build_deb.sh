#!/usr/bin/env bash
# packaging/build_deb.sh BUILD INTO: makes INTO/jnd_VERSION_ARCHITECTURE.deb of what the build folder BUILD installs. The
# same sources give the same bytes, wherever and whenever: times are at most that of the last commit.
set -euo pipefail
build=$(cd "$1" && pwd)
mkdir -p "$2"
into=$(cd "$2" && pwd)
cd "$(dirname "$0")/.."
. packaging/versions.sh
architecture=$(dpkg --print-architecture)
maintainer=$(sed -n 's/^JND_MAINTAINER:STRING=//p' "$build/CMakeCache.txt")
if [ -z "$maintainer" ]; then
  echo "build_deb: $build: expected JND_MAINTAINER in its CMakeCache.txt, found none; configure it again" >&2
  exit 1
fi

stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT
root=$stage/jnd
mkdir "$root"
chmod 755 "$root"
umask 022
DESTDIR=$root cmake --install "$build" --prefix /usr --strip >"$stage/install.log" || { cat "$stage/install.log" >&2; exit 1; }

# Where Debian has its files.
mkdir -p "$root/usr/share/zsh/vendor-completions" "$root/usr/lib/udev/rules.d" "$root/etc/security/limits.d"
mv "$root/usr/share/zsh/site-functions/_jnd" "$root/usr/share/zsh/vendor-completions/"
rmdir "$root/usr/share/zsh/site-functions"
install -m 644 data/system/60-jnd.rules "$root/usr/lib/udev/rules.d/"
install -m 644 data/system/jnd.limits.conf "$root/etc/security/limits.d/jnd.conf"
chmod 755 "$root/usr/share/jnd/data/cluster/power.slurm"  # It begins with #!.
documents=$root/usr/share/doc/jnd
install -m 644 packaging/deb/copyright "$documents/"
# What Debian calls the changelog; what changes for people is CHANGELOG.md.
cat >"$stage/changelog" <<TEXT
jnd ($version) unstable; urgency=medium

  * What changes for those who use jnd is told in CHANGELOG.md.

 -- $maintainer  $(LC_ALL=C date --utc --date="@$SOURCE_DATE_EPOCH" '+%a, %d %b %Y %H:%M:%S +0000')
TEXT
gzip -9n <"$stage/changelog" >"$documents/changelog.gz"
gzip -9n "$root"/usr/share/man/man1/*.1

# Which packages have the libraries that the programs are linked with.
mkdir -p "$stage/source/debian" "$root/DEBIAN"
printf 'Source: jnd\n\nPackage: jnd\nArchitecture: any\n' >"$stage/source/debian/control"
depends=$(cd "$stage/source" && dpkg-shlibdeps -O \
  "$root/usr/bin/jnd" "$root/usr/libexec/jnd/jnd-device-host" "$root"/usr/lib/jnd/devices/*.so | sed -n 's/^shlibs:Depends=//p')

size=$(find "$root" -path "$root/DEBIAN" -prune -o -type f -printf '%s\n' | awk '{sum += int(($1 + 1023) / 1024)} END {print sum}')
control=$(<packaging/deb/control.in)
control=${control//@VERSION@/"$version"}
control=${control//@ARCHITECTURE@/"$architecture"}
control=${control//@MAINTAINER@/"$maintainer"}
control=${control//@INSTALLED_SIZE@/"$size"}
control=${control//@DEPENDS@/"$depends"}
printf '%s\n' "$control" >"$root/DEBIAN/control"
install -m 755 packaging/deb/postinst packaging/deb/postrm "$root/DEBIAN/"
echo /etc/security/limits.d/jnd.conf >"$root/DEBIAN/conffiles"
(cd "$root" && find . -path ./DEBIAN -prune -o -type f -print0 | LC_ALL=C sort -z | xargs -0 md5sum | sed 's|  \./|  |' |
  grep -v '  etc/' >DEBIAN/md5sums)
chmod 644 "$root/DEBIAN/control" "$root/DEBIAN/conffiles" "$root/DEBIAN/md5sums"

# Nothing of this build's own time; dpkg-deb sorts, and takes SOURCE_DATE_EPOCH for the archive itself.
find "$root" -depth -exec touch --no-dereference --date="@$SOURCE_DATE_EPOCH" {} +
package=$into/jnd_${version}_${architecture}.deb
dpkg-deb --root-owner-group --threads-max=1 -Zxz -z6 --build "$root" "$package.unfinished" >/dev/null
mv "$package.unfinished" "$package"
echo "$package"
