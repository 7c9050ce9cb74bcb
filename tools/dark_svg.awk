# dark_svg.awk - a picture of gnuplot or dot, in which what is black is light where a reader prefers the dark.
# It says nothing of the program that drew it.
/^<title>Gnuplot<\/title>$/ || /^<desc>/ { next }
{ print }
/^<svg/ { begins = 1 }
begins && />$/ {
    print "<style>@media (prefers-color-scheme: dark) {"
    print "[stroke='black'], [stroke='rgb(  0,   0,   0)'] { stroke: #e4e4e4; }"
    print "[fill='black'], [fill='rgb(  0,   0,   0)'], text { fill: #e4e4e4; }"
    print "[color='black'], [color='rgb(  0,   0,   0)'] { color: #e4e4e4; } }</style>"
    begins = 0
}
