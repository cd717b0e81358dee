#include "isolux/measure/measure.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "isolux/core/file.h"
#include "isolux/measure/csv.h"
#include "isolux/solution/solution.h"
#include "output.h"

namespace isolux {
namespace {

struct Arguments {
  std::filesystem::path solution, points, output;
};

void run(const Arguments& a) {
  const bool to_file = !a.output.empty();
  if (to_file) {
    check_output(a.output, {".csv"});
    check_distinct(a.points, a.output);
  }
  const std::vector<MeasurePoint> points = load_points(a.points);
  const Solution solution = load_solution(a.solution);
  const std::string csv = measurements_to_csv(measure(solution, points));
  if (to_file) {
    write_file(a.output, csv);
  } else {
    print(csv);
  }
}

}  // namespace

void add_measure(CLI::App& program) {
  const auto a = std::make_shared<Arguments>();
  CLI::App& command = *program.add_subcommand("measure", "Illuminance at given points and normals");
  command.add_option("FILE.glb", a->solution, "the solution")->required()->option_text(" ");
  command.add_option("--points", a->points, "with the columns x,y,z,nx,ny,nz, in m")
      ->required()
      ->option_text("POINTS.csv");
  command.add_option("-o,--output", a->output, "those and Er,Eg,Eb,E,error in lx [stdout]")
      ->option_text("OUT.csv");
  command.callback([a] { run(*a); });
}

}  // namespace isolux
