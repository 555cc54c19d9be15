#!/usr/bin/env bash
# A compiler launcher that notes "USER SYSTEM WALL OBJECT" of each compilation, seconds, in the file
# COMPILE_TIMES: see "What the build costs" in the developer guide.
set -euo pipefail
object=
for word in "$@"; do
  case $word in *.o | *.gch) object=$word ;; esac
done
exec /usr/bin/time -q -a -o "${COMPILE_TIMES:?the file for the times}" -f "%U %S %e $object" "$@"
