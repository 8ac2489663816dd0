#!/usr/bin/env bash
# The script of the composite action: annotations on standard output, SARIF into a file where one is asked for.
#   EDSKIT_PATHS, EDSKIT_FAIL_ON, EDSKIT_SARIF, EDSKIT_ARGUMENTS: the inputs of action.yml
set -uo pipefail

# Blanks separate paths and arguments, as the inputs' descriptions say.
read -r -a paths <<<"${EDSKIT_PATHS:-.}"
read -r -a arguments <<<"${EDSKIT_ARGUMENTS:-}"
options=("${arguments[@]}")
if [[ -n "${EDSKIT_FAIL_ON:-}" ]]; then
    options=(--fail-on "$EDSKIT_FAIL_ON" "${options[@]}")
fi

edskit lint --format github "${options[@]}" "${paths[@]}"
code=$?

# The other two outputs hold the same findings, so their exit codes say nothing new but that one could not be written.
if [[ -n "${EDSKIT_SARIF:-}" ]]; then
    edskit lint --quiet --format sarif --output "$EDSKIT_SARIF" "${options[@]}" "${paths[@]}"
    (($? == 2)) && code=2
fi
if [[ -n "${GITHUB_STEP_SUMMARY:-}" ]]; then
    {
        printf '### edskit lint\n\n```text\n'
        edskit lint --statistics "${options[@]}" "${paths[@]}" 2>&1
        printf '```\n'
    } >>"$GITHUB_STEP_SUMMARY"
fi
exit "$code"
