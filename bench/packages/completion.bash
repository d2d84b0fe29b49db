# Completion of bash for dmocbench: the experiments, and after one of them its options, both as --help lists them.

_dmocbench() {
  local word=${COMP_WORDS[COMP_CWORD]} program=${COMP_WORDS[0]} choices matches
  if [[ $COMP_CWORD -eq 1 ]]; then
    choices="figures --help --version $("$program" --help 2>/dev/null | sed -n 's/^  \([a-z_]*\)  .*/\1/p')"
  elif [[ $word == -* ]]; then
    choices=$("$program" "${COMP_WORDS[1]}" --help 2>/dev/null | sed -n '/^Columns/q; /^  -/p' | grep -oE -- '--[a-z][a-z-]*' | sort -u)
  else
    return # a value: bash offers files
  fi
  matches=$(compgen -W "$choices" -- "$word") # not by <(...), which needs /dev/fd: a minimal system may lack it
  COMPREPLY=()
  if [[ -n $matches ]]; then mapfile -t COMPREPLY <<<"$matches"; fi
}
complete -o bashdefault -o default -F _dmocbench dmocbench
