# Completion of clca in bash. The program says what may follow.

# Splits $1 as the shell does, without what it expands: sets `words`, of which the last may be empty,
# and `front`, what of that one stands before its last = outside of quotes.
_clca_split() {
  local rest=$1 word='' is_word=''
  words=()
  front=''
  while [[ -n $rest ]]; do
    if [[ $rest == [[:space:]]* ]]; then
      [[ -z $is_word ]] || words+=("$word")
      word='' is_word='' front='' rest=${rest:1}
      continue
    fi
    is_word=yes
    case $rest in
      \'*)
        rest=${rest:1}
        word+=${rest%%\'*}
        [[ $rest == *\'* ]] && rest=${rest#*\'} || rest=''
        ;;
      \"*)
        rest=${rest:1}
        while [[ -n $rest && $rest != \"* ]]; do
          [[ $rest == \\[\\\"\$\`]* ]] && rest=${rest:1}
          word+=${rest:0:1} rest=${rest:1}
        done
        rest=${rest:1}
        ;;
      \\*) word+=${rest:1:1} rest=${rest:2} ;;
      =*) word+='=' front=$word rest=${rest:1} ;;
      *) word+=${rest:0:1} rest=${rest:1} ;;
    esac
  done
  words+=("$word")
}

_clca() {
  local begun front option=''
  local -a words lines files=()
  _clca_split "${COMP_LINE:0:COMP_POINT}"
  begun=${words[-1]}
  mapfile -t lines < <("${words[0]/#~\//$HOME/}" __complete "${words[@]:1}" 2>/dev/null)
  if [[ ${lines[0]} == files ]]; then
    [[ $begun == --*=* ]] && option=${begun%%=*}=
    mapfile -t files < <(compgen -f -- "${begun#"$option"}")
    compopt -o filenames -o default 2>/dev/null
  fi
  lines=("${lines[@]:1}")
  COMPREPLY=("${lines[@]%%$'\t'*}" "${files[@]/#/$option}")
  if [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *[.=] ]]; then
    compopt -o nospace 2>/dev/null
  fi
  if [[ $COMP_WORDBREAKS == *=* ]]; then # bash replaces what follows the last one
    COMPREPLY=("${COMPREPLY[@]#"$front"}")
  fi
}
complete -F _clca clca
