# Completion of clca in fish. The program says what may follow.
function __clca_complete
    set -l words (commandline -opc)
    set -l begun
    for closing in '' \' \"
        set begun (string unescape -- (commandline -ct)$closing); and break
    end
    set -l lines ($words[1] __complete $words[2..] "$begun" 2>/dev/null)
    if test "$lines[1]" = files
        set -l option (string match -r -- '^--[^=]*=' $begun)
        string replace -r -- '^' "$option" (__fish_complete_path (string replace -- "$option" '' "$begun"))
    end
    printf '%s\n' $lines[2..]
end
complete -c clca -f -a '(__clca_complete)'
