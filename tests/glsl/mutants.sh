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

tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
cp -r "$root/shaders/penumbra" "$tree/"
export PENUMBRA_SHADERS=$tree

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

total=0 caught=0
cd "$root/shaders/penumbra"
while IFS=: read -r file line start length new; do
    perl -pe "substr(\$_, $start, $length) = '$new' if \$. == $line" "$file" >"$tree/penumbra/$file"
    total=$((total + 1))
    if ! (cd "$tree" && timeout 60 "$programs/test_glsl_functions" && timeout 60 "$programs/test_glsl_lookups") \
        >/dev/null 2>&1; then
        caught=$((caught + 1))
    else
        echo "survives: $file:$line: $(sed -n "${line}p" "$file" | sed 's/^ *//') [at $start: $new]"
    fi
    cp "$file" "$tree/penumbra/$file"
done < <(list_mutants ${1:+"$1.glsl"} $([[ ${1:-} ]] || find . -name '*.glsl' | sed 's|^\./||' | sort))
echo "$caught of $total mutants caught"
