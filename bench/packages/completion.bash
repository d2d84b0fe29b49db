# Completion of bash for dmocbench: the experiments, then the options of an experiment, both as --help lists them, and values
# of options that take names.

_dmocbench() {
  local word=${COMP_WORDS[COMP_CWORD]} program=${COMP_WORDS[0]} option="" before="" choices matches
  # A list a,b,... is completed after its last comma; an "=" is a separate word.
  if [[ $word == *,* ]]; then before=${word%,*},; fi
  [[ $COMP_CWORD -ge 1 ]] && option=${COMP_WORDS[COMP_CWORD - 1]}
  if [[ $option == "=" && $COMP_CWORD -ge 2 ]]; then option=${COMP_WORDS[COMP_CWORD - 2]}; fi
  if [[ $COMP_CWORD -eq 1 || ($COMP_CWORD -eq 2 && $option == help) ]]; then
    choices="figures help --help --version $("$program" --help 2>/dev/null | sed -n 's/^  \([a-z_-]*\)  .*/\1/p')"
  elif [[ $word == -* ]]; then
    choices=$("$program" "${COMP_WORDS[1]}" --help 2>/dev/null | sed -n '/^Columns/q; /^  -/p' | grep -oE -- '--[a-z][a-z-]*' | sort -u)
  else
    case $option in
      --problem | --method | --tableau | --solver | --derivatives | --integrator)
        choices=$("$program" list --names "${option#--}" 2>/dev/null)
        ;;
      --start) choices="common guess $(compgen -f -- "$word")" ;;
      --form) choices="bolza mayer" ;;
      --controls) choices="stage shared" ;;
      --refine) choices="h hp" ;;
      *) return ;; # a value: bash offers files
    esac
  fi
  matches=$(compgen -P "$before" -W "$choices" -- "${word#"$before"}") # not by <(...), which needs /dev/fd: a minimal system may lack it
  COMPREPLY=()
  if [[ -n $matches ]]; then mapfile -t COMPREPLY <<<"$matches"; fi
}
complete -o bashdefault -o default -F _dmocbench dmocbench
