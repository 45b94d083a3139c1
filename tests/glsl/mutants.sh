#!/usr/bin/env bash
# Do the tests of the twins notice? Breaks one constant, sign or comparison of one snippet at a time, and runs them.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

if [[ ${1:-} == --help || ${1:-} == -h ]]; then
    echo "Usage: tests/glsl/mutants.sh [snippet, e.g. occlusion_texture/slices]"
    echo "Needs build/tests of tests/run.sh. Lists the mutants that survive; takes some minutes."
    exit 0
fi
programs=$root/build/tests/g++/tests
[[ -x $programs/test_glsl_functions ]] || { echo "run tests/run.sh --quick first" >&2; exit 2; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Lines of file:line:start:length:text, one a mutant. Comments, #lines and loop headers stay as they are.
list_mutants() {
    perl -ne '
        next if m{^\s*(//|#)} || /\bfor \(/ || /^struct/;
        s{//.*}{};
        while (/(?<![\w.])(\d+\.\d+(?:e[+-]?\d+)?f|\d+u?)(?![\w.])| ([+\-]) |([<>]=?)(?= )| (-)(?=[\w(])/g) {
            my ($text, $start) = (defined $1 ? $1 : defined $2 ? $2 : defined $3 ? $3 : $4, undef);
            $start = defined $1 ? $-[1] : defined $2 ? $-[2] : defined $3 ? $-[3] : $-[4];
            my $new = $text;
            if (defined $1) {
                if ($text =~ /f$/) { (my $v = $text) =~ s/f$//; $new = sprintf("%.9ef", $v == 0 ? 1 : $v * 1.25); }
                elsif ($text =~ /u$/) { (my $v = $text) =~ s/u$//; $new = ($v + 1) . "u"; }
                else { $new = $text + 1; }
            } elsif (defined $2) { $new = $text eq "+" ? "-" : "+"; }
            elsif (defined $3) { $new = {"<" => ">", ">" => "<", "<=" => ">", ">=" => "<"}->{$text}; }
            else { $new = "+"; }
            print "$ARGV:$.:$start:" . length($text) . ":$new\n";
        }
    } continue { close ARGV if eof;' "$@"  # so that lines are counted anew in each file
}

# Says whether the tests notice one of these lines.
try_mutant() {
    local file line start length new
    IFS=: read -r file line start length new <<<"$1"
    local tree=$folder/$BASHPID
    cp -r "$root/shaders" "$tree"
    perl -pe "substr(\$_, $start, $length) = '$new' if \$. == $line" "$file" >"$tree/penumbra/$file"
    local verdict=survives
    for program in functions lookups queries; do
        if ! (cd "$tree" && PENUMBRA_SHADERS=$tree timeout 60 "$programs/test_glsl_$program" --abort-after=1) \
            >/dev/null 2>&1; then
            verdict=caught
            break
        fi
    done
    rm -rf "$tree"
    echo "$verdict: $file:$line: $(sed -n "${line}p" "$file" | sed 's/^ *//') [at $start: $new]"
}
export -f try_mutant
export root folder programs

cd "$root/shaders/penumbra"
files=(${1:+"$1.glsl"})
((${#files[@]})) || mapfile -t files < <(find . -name '*.glsl' | sed 's|^\./||' | sort)
list_mutants "${files[@]}" | xargs -d '\n' -P "$(getconf _NPROCESSORS_ONLN)" -I{} bash -c 'try_mutant "$1"' _ {} >"$folder/verdicts"
grep ^survives "$folder/verdicts" | sort || true
echo "$(grep -c ^caught "$folder/verdicts") of $(wc -l <"$folder/verdicts") mutants caught"
