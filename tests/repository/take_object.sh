# SPDX-License-Identifier: Apache-2.0
# A compiler launcher: sh take_object.sh BUILD COMPILER ARGUMENT…: copies the object that another build of these sources
# has under the same name, and compiles where that has none.
other=$1
shift
object="" depends=""
previous=""
for argument; do
    case $previous in
        -o) object=$argument ;;
        -MF) depends=$argument ;;
    esac
    previous=$argument
done
[ -n "$depends" ] && [ -f "$other/$object" ] || exec "$@"
case $object in
    *.o) cp "$other/$object" "$object" ;;
    *.gch) : >"$object" ;; # nothing is compiled with it, and it is large
    *) exec "$@" ;;
esac
echo "$object:" >"$depends"
