#!/usr/bin/env bash
# Do the tests of the twins notice? Breaks one constant, sign or comparison of one snippet at a time, and runs them.
# mutants.txt says why those that they do not notice change nothing.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

if [[ ${1:-} == --help || ${1:-} == -h ]]; then
    echo "Usage: tests/glsl/mutants.sh [snippet, e.g. occlusion_texture/slices]"
    echo "Needs build/tests of tests/run.sh. Lists the mutants that survive; takes some minutes. Fails if fewer than 95 %"
    echo "are caught, or one that survives is not in mutants.txt."
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
    mkdir "$tree"
    cp -r "$root/shaders" "$root/tests" "$tree"
    perl -pe "substr(\$_, $start, $length) = '$new' if \$. == $line" "$file" >"$tree/shaders/penumbra/$file"
    local verdict=survives
    if ! passes "$tree" "$file"; then verdict=caught; fi
    rm -rf "$tree"
    echo "$verdict: $file: $(sed -n "${line}p" "$file" | sed 's/^ *//') [$((start + 1)): $new]"
}

# Whether the tests that read a snippet pass on a tree: as C++, which is fast and sees reads beyond textures, then on the
# driver.
passes() (
    cd "$1"
    local queries="lookups queries wedge_queries map_queries d_buffer_queries"
    local as_cpp="as_cpp_lookups as_cpp_wedges as_cpp_maps as_cpp_d_buffers"
    case $2 in
        occlusion_texture/*) queries="lookups queries" as_cpp=as_cpp_lookups ;;
        penumbra_wedge/*) queries=wedge_queries as_cpp=as_cpp_wedges ;;
        plan/*) queries='' as_cpp=as_cpp ;;
        soft_shadow_map/*) queries=map_queries as_cpp=as_cpp_maps ;;
        umbra_volume/*) queries=d_buffer_queries as_cpp=as_cpp_d_buffers ;;
    esac
    for program in $as_cpp; do
        g++ -std=c++17 -O1 -I"$root/include" -Itests tests/main.cpp "tests/glsl/$program.cpp" -o "$program" 2>/dev/null &&
            PENUMBRA_SHADERS=$1/shaders timeout 300 "./$program" --abort-after=1 >/dev/null 2>&1 || exit 1
    done
    for program in functions $queries; do
        PENUMBRA_SHADERS=$1/shaders timeout 300 "$programs/test_glsl_$program" --abort-after=1 >/dev/null 2>&1 || exit 1
    done
)
export -f try_mutant passes
export root folder programs

cp -r "$root/shaders" "$root/tests" "$folder"
passes "$folder" all || { echo "the tests fail without any mutant" >&2; exit 2; }

cd "$root/shaders/penumbra"
files=(${1:+"$1.glsl"})
((${#files[@]})) || mapfile -t files < <(find . -name '*.glsl' | sed 's|^\./||' | sort)
list_mutants "${files[@]}" | xargs -d '\n' -P "$(getconf _NPROCESSORS_ONLN)" -I{} bash -c 'try_mutant "$1"' _ {} >"$folder/verdicts"
grep ^survives "$folder/verdicts" | sed 's/^survives: //' | sort >"$folder/survivors" || true
total=$(wc -l <"$folder/verdicts") alive=$(wc -l <"$folder/survivors")
cat "$folder/survivors"
echo "$((total - alive)) of $total mutants caught"
if grep -vxFf <(grep -v -e '^#' -e '^$' "$root/tests/glsl/mutants.txt") "$folder/survivors" >"$folder/unexplained"; then
    echo "not in mutants.txt:" && cat "$folder/unexplained"
    exit 1
fi
((100 * alive <= 5 * total)) || { echo "fewer than 95 %"; exit 1; }
