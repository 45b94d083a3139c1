#include "plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <stdexcept>
#include <vector>

namespace penumbra::study {
namespace {

// Okabe & Ito's palette for the colour-blind; the page uses the same. The accent is for the front alone.
constexpr std::array<const char*, 5> colors = {"#0072b2", "#009e73", "#cc79a7", "#56b4e9", "#e69f00"};
constexpr const char *accent = "#d55e00", *ink = "#22242a", *soft = "#8a8f98";
constexpr std::array<int, 5> shapes = {7, 5, 9, 13, 11};  // gnuplot's disk, square, triangle, diamond, triangle down

std::string in_quotes(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
    return result + "'";
}

/// Distinct values in order of first appearance.
std::vector<std::string> distinct(const std::vector<std::string>& values) {
    std::vector<std::string> result;
    for (const std::string& value : values)
        if (std::find(result.begin(), result.end(), value) == result.end()) result.push_back(value);
    return result;
}

/// What people call a knob's value.
std::string plain(const std::string& name) {
    static const std::map<std::string, std::string> names = {
        {"n_buffer", "N-Buffer"}, {"mipmap", "mip-map"}, {"summed_area", "summed area"}};
    const auto known = names.find(name);
    if (known != names.end()) return known->second;
    std::string text = name;
    std::replace(text.begin(), text.end(), '_', ' ');
    return text;
}

std::string color_key(const Row& row) { return knob_text(row, "filter", row.method); }
std::string shape_key(const Row& row) { return knob_text(row, "combination"); }
std::string curve_key(const RayRow& row) { return fmt::format("{} {}", row.sampler, row.packet); }

/// gnuplot text with its data: named blocks first, then one plot command.
class Script {
  public:
    void add(const std::string& data, const std::string& clause) {
        const std::string block = fmt::format("$d{}", plots_.size());
        blocks_ += fmt::format("{} << EOD\n{}EOD\n", block, data);
        plots_.push_back(block + " " + clause);
    }
    void key(const std::string& clause) { plots_.push_back("keyentry " + clause); }
    std::string text(const std::string& head) const {
        std::string all = blocks_ + head + "plot ";
        for (std::size_t i = 0; i < plots_.size(); ++i) all += (i == 0 ? "" : ", \\\n     ") + plots_[i];
        return all + "\n";
    }

  private:
    std::string blocks_;
    std::vector<std::string> plots_;
};

/// Every sampler as a soft line, and the best of them at any time as a strong one.
void add_rays(Script& script, const Study& study, const std::string& scene) {
    std::map<std::string, std::string> curves;
    std::vector<const RayRow*> by_time;
    for (const RayRow& row : study.ray_rows) {
        if (row.scene != scene) continue;
        curves[curve_key(row)] += fmt::format("{} {}\n", row.ns_per_point, row.rmse);
        by_time.push_back(&row);
    }
    if (by_time.empty()) return;
    for (const auto& curve : curves)
        script.add(curve.second, fmt::format("with lines lc rgb '{}' lw 0.8 notitle", soft));
    script.key(fmt::format("with lines lc rgb '{}' lw 0.8 title 'Embree, {} samplers'", soft, curves.size()));
    std::sort(by_time.begin(), by_time.end(),
              [](const RayRow* a, const RayRow* b) { return a->ns_per_point < b->ns_per_point; });
    std::string best;
    double least = by_time.front()->rmse * 2.0;
    for (const RayRow* row : by_time) {
        if (row->rmse >= least) continue;
        least = row->rmse;
        best += fmt::format("{} {}\n", row->ns_per_point, row->rmse);
    }
    script.add(best, fmt::format("with lines lc rgb '{}' lw 2 title 'Embree, the best of them'", ink));
}

void add_rows(Script& script, const Study& study, const std::string& scene) {
    std::vector<std::string> hues, forms;
    for (const Row& row : study.rows) {
        if (row.scene != scene) continue;
        hues.push_back(color_key(row));
        forms.push_back(shape_key(row));
    }
    hues = distinct(hues), forms = distinct(forms);
    for (std::size_t h = 0; h < hues.size(); ++h) {
        for (std::size_t f = 0; f < forms.size(); ++f) {
            std::string data;
            for (const Row& row : study.rows)
                if (row.scene == scene && color_key(row) == hues[h] && shape_key(row) == forms[f])
                    data += fmt::format("{} {}\n", row.ns_per_point, row.rmse);
            if (data.empty()) continue;
            script.add(data, fmt::format("with points lc rgb '{}' pt {} ps 0.7 notitle", colors[h % colors.size()],
                                         shapes[f % shapes.size()]));
        }
    }
    std::string front;
    for (const Row* row : pareto_front(study, scene)) front += fmt::format("{} {}\n", row->ns_per_point, row->rmse);
    if (!front.empty()) script.add(front, fmt::format("with steps lc rgb '{}' lw 2 title 'best for its time'", accent));
    for (std::size_t h = 0; h < hues.size(); ++h)
        script.key(fmt::format("with points lc rgb '{}' pt 7 ps 0.9 title {}", colors[h % colors.size()],
                               in_quotes(plain(hues[h]))));
    for (std::size_t f = 0; forms.size() > 1 && f < forms.size(); ++f)
        script.key(fmt::format("with points lc rgb '{}' pt {} ps 0.8 title {}", soft, shapes[f % shapes.size()],
                               in_quotes(plain(forms[f]))));
}

std::string nanoseconds(double ns) {
    return ns < 1e3   ? fmt::format("{:g} ns", ns)
           : ns < 1e6 ? fmt::format("{:g} µs", ns / 1e3)
                      : fmt::format("{:g} ms", ns / 1e6);
}

/// A range that holds the positive values with some air; ticks at the powers of ten times each of `leading`.
template <class Label>
std::string axis(const char* name, const std::vector<double>& values, const std::vector<double>& leading,
                 Label&& label) {
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

}  // namespace

std::string file_name(const std::string& scene) {
    std::string name;
    for (const char c : scene) name += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ? c : '_';
    return name;
}

bool write_plot(const Study& study, const std::string& scene, const std::filesystem::path& folder) {
    const std::string name = "plot-" + file_name(scene);
    Script script;
    add_rows(script, study, scene);
    add_rays(script, study, scene);
    std::vector<double> times, errors;
    const auto collect = [&](const auto& rows) {
        for (const auto& row : rows)
            if (row.scene == scene) times.push_back(row.ns_per_point), errors.push_back(row.rmse);
    };
    collect(study.rows), collect(study.ray_rows);
    const std::string head =
        fmt::format(
            "set terminal svg size 960,520 font 'sans-serif,14' background '#ffffff'\n"
            "set encoding utf8\nset output {}\n"
            "set title {} noenhanced\nset xlabel 'time per point'\nset ylabel 'RMSE of visibility'\n"
            "set logscale xy\nset border 3 lc rgb '{}'\nset tics nomirror scale 0.6 textcolor rgb '{}'\n"
            "set grid lc rgb '#e4e6ea' lt 1 lw 0.8\n"
            "set rmargin at screen 0.74\n"
            "set key at screen 0.76, graph 1 left top vertical maxcols 1 Left reverse samplen 2 spacing 1.2 "
            "noenhanced\n",
            in_quotes(name + ".svg"), in_quotes(scene), soft, ink) +
        axis("x", times, {1.0}, nanoseconds) +
        axis("y", errors, {1.0, 2.0, 5.0}, [](double error) { return fmt::format("{:.4g}", error); });
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
