#include "gnuplot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace penumbra::study {

std::string in_quotes(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
    return result + "'";
}

void PlotScript::add(const std::string& data, const std::string& clause) {
    const std::string block = fmt::format("$d{}", plots_.size());
    blocks_ += fmt::format("{} << EOD\n{}EOD\n", block, data);
    plots_.push_back(block + " " + clause);
}

std::string PlotScript::text(const std::string& head) const {
    std::string all = blocks_ + head + "plot ";
    for (std::size_t i = 0; i < plots_.size(); ++i) all += (i == 0 ? "" : ", \\\n     ") + plots_[i];
    return all + "\n";
}

std::string nanoseconds(double ns) {
    return ns < 1e3   ? fmt::format("{:g} ns", ns)
           : ns < 1e6 ? fmt::format("{:g} µs", ns / 1e3)
                      : fmt::format("{:g} ms", ns / 1e6);
}

std::string log_axis(const char* name, const std::vector<double>& values, const std::vector<double>& leading,
                     const std::function<std::string(double)>& label) {
    double low = 0.0, high = 0.0;
    for (const double value : values) {
        if (!(value > 0.0)) continue;
        low = low > 0.0 ? std::min(low, value) : value;
        high = std::max(high, value);
    }
    if (!(low > 0.0)) return "";
    low /= 1.35, high *= 1.35;
    std::string ticks;
    for (int power = static_cast<int>(std::floor(std::log10(low))); power <= std::log10(high); ++power)
        for (const double digit : leading)
            ticks += fmt::format("{}'{}' {:g}", ticks.empty() ? "" : ", ", label(digit * std::pow(10.0, power)),
                                 digit * std::pow(10.0, power));
    return fmt::format("set {0}range [{1:g}:{2:g}]\nset {0}tics ({3})\n", name, low, high, ticks);
}

bool draw_plot(const std::filesystem::path& folder, const std::string& name, const PlotScript& script,
               const PlotFrame& frame) {
    constexpr const char* beside =
        "set rmargin at screen 0.74\n"
        "set key at screen 0.76, graph 1 left top vertical maxcols 1 Left reverse samplen 2 spacing 1.2 noenhanced";
    constexpr const char* below = "set key below center maxcols 2 Left reverse samplen 2 spacing 1.2 noenhanced";
    const std::string head = fmt::format(
        "set terminal svg size 960,520 font 'sans-serif,14' background '#ffffff'\n"
        "set encoding utf8\nset output {}\n"
        "set title {} noenhanced\nset xlabel {}\nset ylabel {}\n{}"
        "set border 3 lc rgb '{}'\nset tics nomirror scale 0.6 textcolor rgb '{}'\n"
        "set grid lc rgb '#e4e6ea' lt 1 lw 0.8\n"
        "{}\n",
        in_quotes(name + ".svg"), in_quotes(frame.title), in_quotes(frame.x_title), in_quotes(frame.y_title),
        frame.axes, soft, ink, frame.key_below ? below : beside);
    const std::filesystem::path file = folder / (name + ".gp");
    if (!(std::ofstream(file) << script.text(head)))
        throw std::runtime_error(fmt::format("cannot write '{}'", file.string()));
    // in the shell's single quotes, a quote is '\''
    std::string place;
    for (const char c : folder.string()) place += c == '\'' ? std::string("'\\''") : std::string(1, c);
    const std::string command = fmt::format("cd '{}' && gnuplot '{}.gp' 2>/dev/null", place, name);
    return std::system(command.c_str()) == 0;
}

}  // namespace penumbra::study
