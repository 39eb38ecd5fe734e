# Completion of evenglow in bash. Commands and options are asked of the program, so that they cannot differ.

_evenglow_words() { # COMMAND...: what its help lists under a heading of commands, and its options
  "${COMP_WORDS[0]}" "$@" --help 2>/dev/null | sed -nE \
    -e '/^(Commands|Subcommands):/,/^$/s/^  ([a-z][a-z0-9_-]*) .*/\1/p' \
    -e 's/^  (-[a-zA-Z]),(--[a-z0-9_-]+).*/\1\n\2/p' \
    -e 's/^  (--[a-z0-9_-]+).*/\1/p'
}

_evenglow() {
  local current=${COMP_WORDS[COMP_CWORD]} word
  local -a command=()
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    if [[ $word == [a-z]* && $word != *.* && $word != */* && ${#command[@]} -lt 2 ]]; then command+=("$word"); fi
  done
  if [[ ${#command[@]} -eq 2 && ${command[0]} != film ]]; then command=("${command[0]}"); fi
  mapfile -t COMPREPLY < <(compgen -W "$(_evenglow_words "${command[@]}")" -- "$current")
  if [[ $current != -* && ${#command[@]} -gt 0 ]]; then
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$current")
  fi
}

complete -o filenames -F _evenglow evenglow ./evenglow
