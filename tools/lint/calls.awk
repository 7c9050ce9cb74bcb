# calls.awk - reads calls.txt, then `nm -A -u`, and names every undefined symbol not allowed.
FILENAME ~ /calls\.txt$/ {
    if (!/^#/ && NF == 2) { files[++rules] = "^(" $1 ")$"; symbols[rules] = "^(" $2 ")$" }
    next
}
{
    file = $1
    sub(/\.o:.*$/, "", file)
    if (index(file, build) == 1) file = substr(file, length(build) + 1)
    name = $NF
    if (name ~ /^dal_/) next
    for (i = 1; i <= rules; i++)
        if (file ~ files[i] && name ~ symbols[i]) next
    print file ".c: calls " name
}
