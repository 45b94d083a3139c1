// The gate: every public function has a twin, or a reason for having none, in twins.txt; twins take the same arguments
// in the same order; header blocks of snippets say what is in them.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "program.hpp"

namespace fs = std::filesystem;

namespace {

using Names = std::vector<std::string>;

std::vector<std::string> lines_of(const fs::path& file) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error("cannot read " + file.string());
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// Names of the arguments of a declaration whose "(" is at `open`: the last word of each, default values left out.
std::string arguments(const std::string& text, std::size_t open) {
    std::string result, current;
    int depth = 0;
    for (std::size_t i = open + 1; i < text.size(); ++i) {
        const char c = text[i];
        if (c == ')' && depth == 0) break;
        depth += c == '(' || c == '<' ? 1 : c == ')' || c == '>' ? -1 : 0;
        if (c == ',' && depth == 0)
            current += '\n';
        else
            current += c;
    }
    std::istringstream all(current);
    for (std::string one; std::getline(all, one);) {
        one = one.substr(0, one.find('='));
        std::smatch match;
        if (std::regex_search(one, match, std::regex(R"((\w+)\s*$)")))
            result += (result.empty() ? "" : ", ") + match.str(1);
    }
    return result;
}

/// A declaration from its line on, comments left out, until its parentheses are closed.
std::string joined(const std::vector<std::string>& lines, std::size_t i) {
    std::string text;
    int depth = 0;
    bool opened = false;
    for (; i < lines.size() && (!opened || depth > 0); ++i) {
        const std::string line = lines[i].substr(0, lines[i].find("//"));
        for (const char c : line) depth += c == '(' ? 1 : c == ')' ? -1 : 0, opened = opened || c == '(';
        text += line + " ";
    }
    return text;
}

/// "name(a, b)" of every public function of a header: free ones, and members that are defined in their class.
std::set<std::string> public_functions(const std::vector<std::string>& lines) {
    const std::string type = R"([A-Za-z_][\w:<>, ]*[ &*]+)";
    const std::string no_type =
        "(?!template|using|return|namespace|struct|class|enum|if|for|else|while|switch|case|friend)";
    const std::regex free_function("^" + no_type + type + R"((\w+)\()");
    const std::regex member("^    " + no_type + type + R"((\w+)\()");
    const std::regex type_start(R"(^(struct|class) (\w+))");
    std::set<std::string> result;
    std::string inside;
    bool detail = false, is_public = false;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string& line = lines[i];
        std::smatch match;
        if (line == "namespace detail {" || line == "namespace penumbra::detail {") detail = true;
        if (line == "}  // namespace detail" || line == "}  // namespace penumbra::detail") detail = false;
        if (detail) continue;
        if (std::regex_search(line, match, type_start) && line.find(';') == std::string::npos)
            inside = match.str(2), is_public = match.str(1) == "struct";
        if (line.rfind("};", 0) == 0) inside.clear();
        if (line.find("  public:") == 0) is_public = true;
        if (line.find("  private:") == 0) is_public = false;
        const bool at_class = !inside.empty() && is_public;
        if (!std::regex_search(line, match, at_class ? member : free_function)) continue;
        const std::string name = match.str(1);
        if (name == inside || name == "operator" || name == "decltype") continue;
        const std::string text = joined(lines, i);
        const std::string call = name + "(" + arguments(text, text.find(name + "(") + name.size()) + ")";
        result.insert(at_class ? inside + "::" + call : call);
    }
    return result;
}

std::set<std::string> functions_of_snippet(const std::vector<std::string>& lines) {
    const std::regex start(R"(^\w+ (penumbra_\w+)\()");
    std::set<std::string> result;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::smatch match;
        if (!std::regex_search(lines[i], match, start)) continue;
        const std::string text = joined(lines, i), name = match.str(1);
        result.insert(name + "(" + arguments(text, text.find(name + "(") + name.size()) + ")");
    }
    return result;
}

/// A line of twins.txt: "header; function(arguments); twin; reason".
struct Entry {
    std::string header, function, twin, reason;
};

std::vector<Entry> entries() {
    std::vector<Entry> result;
    for (const std::string& line : lines_of(fs::path(PENUMBRA_SHADERS).parent_path() / "tests/glsl/twins.txt")) {
        if (line.empty() || line[0] == '#') continue;
        Entry entry;
        std::istringstream in(line);
        for (std::string* part : {&entry.header, &entry.function, &entry.twin, &entry.reason}) {
            std::getline(in, *part, ';');
            part->erase(0, part->find_first_not_of(' '));
        }
        result.push_back(entry);
    }
    return result;
}

/// Below a folder, by path without extension.
std::map<std::string, std::vector<std::string>> read_all(const fs::path& root, const std::string& extension) {
    std::map<std::string, std::vector<std::string>> result;
    for (const auto& file : fs::recursive_directory_iterator(root)) {
        if (file.path().extension() != extension) continue;
        const fs::path name = fs::relative(file.path(), root).replace_extension();
        if (name.string().rfind("reference", 0) != 0) result[name.string()] = lines_of(file.path());
    }
    return result;
}

const fs::path shaders = fs::path(PENUMBRA_SHADERS) / "penumbra";
const fs::path headers = fs::path(PENUMBRA_SHADERS).parent_path() / "include/penumbra";

}  // namespace

TEST_CASE("the parser finds what it should") {
    const Names header{"/// f(no) is a comment",
                       "template <class T>",
                       "T free_one(T a, const Vec3<T>& b = Vec3<T>(T(0), T(1)),",
                       "           std::array<T, 2> c) {",
                       "    return inner(a);",
                       "}",
                       "struct S {",
                       "    T member(int x) const { return x; }",
                       "};",
                       "class C {",
                       "    int hidden(int y) { return y; }",
                       "  public:",
                       "    int shown() const { return 1; }",
                       "  private:",
                       "    int hidden_too(int z) { return z; }",
                       "};",
                       "namespace detail {",
                       "int not_public(int q) { return q; }",
                       "}  // namespace detail",
                       "namespace penumbra::detail {",
                       "int not_public_either(int q) { return q; }",
                       "}  // namespace penumbra::detail",
                       "inline int last(int n) { return n; }"};
    CHECK(public_functions(header) ==
          std::set<std::string>{"free_one(a, b, c)", "S::member(x)", "C::shown()", "last(n)"});
    const Names snippet{"// float penumbra_no(float a) {", "float penumbra_yes(float a,",
                        "                   vec2 b) {", "}"};
    CHECK(functions_of_snippet(snippet) == std::set<std::string>{"penumbra_yes(a, b)"});
}

TEST_CASE("every public function is listed, and nothing else") {
    std::map<std::string, std::set<std::string>> listed;
    for (const Entry& entry : entries())
        if (entry.function != "-") listed[entry.header].insert(entry.function);
    for (const auto& file : read_all(headers, ".hpp")) {
        const std::string& header = file.first;
        if (header.rfind("detail/", 0) == 0) continue;  // listed where it has twins
        CAPTURE(header);
        for (const std::string& function : public_functions(file.second)) {
            CAPTURE(function);
            CHECK_MESSAGE(listed[header].erase(function) == 1, "a public function without a line in twins.txt");
        }
        for (const std::string& function : listed[header]) FAIL_CHECK(header << ": " << function << " is not there");
    }
}

TEST_CASE("twins are there and take the same arguments, and what has none says why") {
    auto snippets = read_all(shaders, ".glsl");
    std::map<std::string, std::set<std::string>> left;
    for (const auto& [name, lines] : snippets) left[name] = functions_of_snippet(lines);
    std::set<std::string> used;
    for (const Entry& entry : entries()) {
        CAPTURE(entry.header);
        CAPTURE(entry.function);
        if (entry.function == "-") continue;
        if (entry.twin == "-") {
            CHECK_MESSAGE(!entry.reason.empty(), "no twin, and no reason");
            continue;
        }
        const bool member = entry.function.find("::") != std::string::npos;
        const std::string wanted = entry.function.substr(entry.function.find('('));
        bool found = false;
        for (const std::string& twin : left[entry.header]) {
            if (twin.rfind(entry.twin + "(", 0) != 0) continue;
            std::string got = twin.substr(twin.find('('));
            if (member && entry.reason.empty()) {  // the object comes first
                const auto comma = got.find(", ");
                got = comma == std::string::npos ? "()" : "(" + got.substr(comma + 2);
            }
            if (!entry.reason.empty() || got == wanted) found = true, used.insert(entry.header + twin);
        }
        CHECK_MESSAGE(found, "no twin with these arguments");
    }
    // what is left helps a twin, and is listed as such: "snippet; -; function"
    for (const Entry& entry : entries())
        if (entry.function == "-") used.insert(entry.header + entry.twin);
    for (const auto& snippet : left)
        for (const std::string& function : snippet.second) {
            const std::string& name = snippet.first;
            const std::string plain = function.substr(0, function.find('('));
            CAPTURE(name);
            CAPTURE(function);
            CHECK_MESSAGE((used.count(name + function) + used.count(name + plain)) > 0, "nobody's twin");
        }
}

TEST_CASE("header blocks say what snippets have, and snippets have nothing that drivers compute differently") {
    const std::regex forbidden(
        R"(\b(asin|acos|atan|pow|log2|smoothstep|packUnorm\w*|packHalf\w*|uniform)\b|#version|#extension)");
    for (const auto& file : read_all(shaders, ".glsl")) {
        const std::string& name = file.first;
        CAPTURE(name);
        std::string block, code;
        bool in_block = true;
        for (const std::string& line : file.second) {
            in_block = in_block && line.rfind("//", 0) == 0;
            (in_block ? block : code) += (in_block ? line : line.substr(0, line.find("//"))) + "\n";
        }
        for (const char* part : {"// Options: ", "// Error:   ", "// C++:     "}) {
            CAPTURE(part);
            CHECK(block.find(part) != std::string::npos);
        }
        const std::regex include(R"(// C\+\+:     include/penumbra/(\S+)\.hpp)");
        std::smatch match;
        CHECK((std::regex_search(block, match, include) && match.str(1) == name));
        CHECK(code.rfind("#ifndef PENUMBRA_", 0) == 0);
        CHECK_MESSAGE(!std::regex_search(code, forbidden), "not in a snippet");
        // options: macros that are guarded, but for the snippet's own guard
        std::set<std::string> guarded, told;
        const std::regex guard(R"(#ifndef (PENUMBRA_\w+)\n#define \1 \S)"),
            option(R"(//[ A-Za-z:]* (PENUMBRA_[A-Z_]+)  )");
        for (std::sregex_iterator i(code.begin(), code.end(), guard), end; i != end; ++i) guarded.insert(i->str(1));
        const std::string options =
            block.substr(block.find("// Options:"), block.find("// Error:") - block.find("// Options:"));
        for (std::sregex_iterator i(options.begin(), options.end(), option), end; i != end; ++i) told.insert(i->str(1));
        CHECK(guarded == told);
    }
}
