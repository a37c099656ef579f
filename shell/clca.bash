# Completion of clca in bash. The program says what may follow.
_clca() {
  local line=${COMP_LINE:0:COMP_POINT} begun
  local -a words lines files=()
  read -ra words <<<"$line"
  if [[ $line == *[[:space:]] ]]; then
    words+=('')
  fi
  begun=${words[-1]}
  mapfile -t lines < <("${words[0]/#~\//$HOME/}" __complete "${words[@]:1}" 2>/dev/null)
  if [[ ${lines[0]} == files ]]; then
    mapfile -t files < <(compgen -f -- "$begun")
    compopt -o filenames -o default 2>/dev/null
  fi
  lines=("${lines[@]:1}")
  COMPREPLY=("${lines[@]%%$'\t'*}" "${files[@]}")
  if [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *[.=] ]]; then
    compopt -o nospace 2>/dev/null
  fi
  if [[ $begun == *=* && $COMP_WORDBREAKS == *=* ]]; then # bash replaces what follows the last one
    COMPREPLY=("${COMPREPLY[@]#"${begun%"${begun##*=}"}"}")
  fi
}
complete -F _clca clca
