# completion.awk - what bash completes of dalembert, made of the reference that `dalembert help
# --markdown` prints: commands, options, the words of those that take one, and names of built-in
# systems and methods.
BEGIN { tick = "`" }
/^## Exit status$/ { exit }
/^## / { command = $2; commands = commands " " command }
/^    dalembert .* SYSTEM/ { systems = systems command "|" }
function add(option) {
    if (!index(options[command] " ", " " option " ")) options[command] = options[command] " " option
}
/^- `--/ {
    split($0, part, tick)
    split(part[2], name, " ")
    add(name[1])
    if (name[2] ~ /^[a-z-]+(\|[a-z-]+)+$/ && !(name[1] in has_words)) {
        gsub(/\|/, " ", name[2])
        has_words[name[1]] = 1
        words = words "    *:" name[1] ") words='" name[2] "' ;;\n"
    }
}
/^As for / {
    n = split($0, part, tick)
    for (i = 2; i <= n; i += 2) add(part[i])
}
END {
    print "# bash completion of dalembert"
    print "_dalembert()\n{"
    print "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} words="
    print "    local command=${COMP_WORDS[1]} names='s/^| `\\([a-z0-9-]*\\)`.*/\\1/p'"
    print "    case $COMP_CWORD:$before in"
    print "    1:*) words='" substr(commands, 2) " --help --version' ;;"
    printf "%s", words
    print "    *:--integrator) words=$(\"$1\" list integrators --markdown | sed -n \"$names\") ;;"
    print "    *)"
    print "        case $command in"
    n = split(substr(commands, 2), list, " ")
    for (i = 1; i <= n; i++) print "        " list[i] ") words='" substr(options[list[i]], 2) " --help' ;;"
    print "        esac"
    print "        case $command in"
    print "        " substr(systems, 1, length(systems) - 1) ")"
    print "            [[ $word == -* ]] || words=$(\"$1\" list systems --markdown | sed -n \"$names\") ;;"
    print "        esac ;;"
    print "    esac"
    print "    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))"
    print "}"
    print "complete -o default -F _dalembert dalembert"
}
