# For `source` by the scripts beside it: with --help, prints the comment that begins the script, and ends it.
# shellcheck shell=bash
if [[ ${1-} == --help || ${1-} == -h ]]; then
  sed -n '2,${/^#/!q;s/^# \{0,1\}//p}' "$0"
  exit
fi
