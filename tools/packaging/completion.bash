# Completion of ceres_dhcal and its companions in bash. The programs tell their flags (--help) and
# robots (init --list) themselves.

_ceres_dhcal() {
  local program="${COMP_WORDS[0]}" word="${COMP_WORDS[COMP_CWORD]}"
  local before="${COMP_WORDS[COMP_CWORD - 1]}" pattern='*' choices=""
  COMPREPLY=()
  case "$before" in
    --method) choices="svd_gauss_newton levenberg_marquardt both" ;;
    --diagnosis) choices="auto always never" ;;
    --frame) choices="base world" ;;
    --direction) choices="right left down up" ;;
    --rulings) choices="dark light" ;;
    --out | --data_dir) pattern=/ ;;
  esac
  if [ -z "$choices" ] && [ "${COMP_WORDS[1]}" = init ] && [ "$pattern" = '*' ]; then
    choices="$("$program" init --list 2>/dev/null | cut -d ' ' -f 1) --list --out"
  elif [ -z "$choices" ] && [[ "$word" == -* ]]; then
    choices="$("$program" --help 2>/dev/null | grep -oE -e '--[a-z_-]+' | sort -u)"
  elif [ -z "$choices" ] && [ "$COMP_CWORD" -eq 1 ] && [ "${program##*/}" = ceres_dhcal ]; then
    choices=init
  fi
  mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$word")
  [ "${#COMPREPLY[@]}" -gt 0 ] && [ "$choices" != init ] && return
  local -a paths
  if [ "$pattern" = / ]; then
    mapfile -t paths < <(compgen -d -- "$word")
  else
    mapfile -t paths < <(compgen -f -- "$word")
  fi
  COMPREPLY+=("${paths[@]}")
}

complete -o filenames -F _ceres_dhcal ceres_dhcal dhcal_simulate dhcal_compensate dhcal_compare \
  dhcal_convert dhcal_plan dhcal_ruler
