# Completion of clca in fish. The program says what may follow.
function __clca_complete
    set -l words (commandline -opc)
    set -l begun (commandline -ct)
    set -l lines ($words[1] __complete $words[2..] "$begun" 2>/dev/null)
    test "$lines[1]" = files; and __fish_complete_path "$begun"
    printf '%s\n' $lines[2..]
end
complete -c clca -f -a '(__clca_complete)'
