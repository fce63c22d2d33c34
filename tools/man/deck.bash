# Completion of deck in bash: verbs, options and the values that --help lists.
_deck() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} verb=${COMP_WORDS[1]} words
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    words=$(deck --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p; s/^  *\(--[a-z0-9-]*\) .*/\1/p')
    COMPREPLY=($(compgen -W "$words" -- "$current"))
    return
  fi
  # --option=value comes as three words.
  [ "$current" = = ] && current=
  [ "$previous" = = ] && previous=${COMP_WORDS[COMP_CWORD-2]}
  if [ "${previous#-}" != "$previous" ]; then
    words=$(deck "$verb" --help | sed -n "s/^ *\(-[a-z],\)\{0,1\}$previous [A-Z=]*:{\([^}]*\)}.*/\2/p" | tr , ' ')
    [ -n "$words" ] && COMPREPLY=($(compgen -W "$words" -- "$current")) && return
  fi
  if [ "${current#-}" != "$current" ]; then
    words=$(deck "$verb" --help | sed -n 's/^ *\(-[a-z],\)\{0,1\}\(--[a-z0-9-]*\).*/\2/p')
    COMPREPLY=($(compgen -W "$words" -- "$current"))
    return
  fi
  compopt -o filenames 2>/dev/null
  COMPREPLY=($(compgen -f -- "$current"))
}
complete -F _deck deck
