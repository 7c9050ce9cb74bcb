# completion.awk - what bash completes of dalembert, made of the reference that `dalembert help
# --markdown` prints: commands, options, and after an option what may follow it: its words, names
# of built-in methods and tags, else files.  -o is --output.
BEGIN { tick = "`" }
/^## Exit status$/ { exit }
/^## / { command = $2; commands = commands " " command }
/^    dalembert .* SYSTEM/ { systems = systems command "|" }
function add(option) {
    if (!index(options[command] " ", " " option " ")) options[command] = options[command] " " option
    if (option == "--output") add("-o")
}
/^- `--/ {
    split($0, part, tick)
    split(part[2], name, " ")
    add(name[1])
    if (name[2] == "" || name[1] in has_value) next
    has_value[name[1]] = 1
    if (name[2] ~ /^[a-z-]+(\|[a-z-]+)+$/) {
        gsub(/\|/, " ", name[2])
        words = words "    *:" name[1] ") words='" name[2] "' ;;\n"
    } else if (name[1] !~ /^--(integrators?|tag)$/) {
        others = others "|*:" name[1]
    }
}
/^As for / {
    n = split($0, part, tick)
    for (i = 2; i <= n; i += 2) add(part[i])
}
END {
    print "# bash completion of dalembert"
    print "_dalembert()\n{"
    print "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} words= list="
    print "    local command=${COMP_WORDS[1]} names='s/^| `\\([a-z0-9-]*\\)`.*/\\1/p'"
    print "    # bash splits --option=value in three."
    print "    [[ $before == = ]] && before=${COMP_WORDS[COMP_CWORD - 2]}"
    print "    [[ $word == = ]] && word="
    print "    case $COMP_CWORD:$before in"
    print "    1:*) words='" substr(commands, 2) " --help --version' ;;"
    printf "%s", words
    print "    *:--integrator|*:--integrators)"
    print "        words=$(\"$1\" list integrators --markdown | sed -n \"$names\")"
    print "        [[ $before == --integrators && $word == *,* ]] && list=${word%,*}, ;;"
    print "    *:--tag) words=$(\"$1\" list systems --long --markdown |"
    print "        sed '1,2d; s/^.*| \\(.*\\) |$/\\1/; s/,//g') ;;"
    print "    *:-o" others ") ;;"
    print "    2:help) words='" substr(commands, 2) "' ;;"
    print "    *)"
    print "        case $command in"
    n = split(substr(commands, 2), list, " ")
    for (i = 1; i <= n; i++) print "        " list[i] ") words='" substr(options[list[i]], 2) " --help' ;;"
    print "        esac"
    print "        case $command in"
    print "        list) [[ $word == -* ]] || words='systems integrators' ;;"
    print "        " substr(systems, 1, length(systems) - 1) ")"
    print "            [[ $word == -* ]] || words=$(\"$1\" list systems --markdown | sed -n \"$names\") ;;"
    print "        esac ;;"
    print "    esac"
    print "    COMPREPLY=($(compgen -P \"$list\" -W \"$words\" -- \"${word#\"$list\"}\"))"
    print "}"
    print "complete -o default -F _dalembert dalembert"
}
