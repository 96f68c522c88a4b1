// SPDX-License-Identifier: MIT
// minkray verify: proves that a planner's motion is free of collisions, also between waypoints.
#include <algorithm>
#include <chrono>
#include <exception>
#include <iostream>
#include <memory>
#include <optional>

#include "core/parallel/parallel.h"
#include "core/parallel/parallel_pipeline.h"
#include "renderer/arguments/import_arguments.h"
#include "renderer/arguments/scene_file.h"
#include "renderer/base/build.h"
#include "renderer/base/csv.h"
#include "renderer/base/errors.h"
#include "renderer/cli/exit_code.h"
#include "renderer/cli/options.h"
#include "renderer/cli/verbs.h"
#include "renderer/import/import.h"
#include "renderer/io/image_file.h"
#include "renderer/io/output_file.h"
#include "renderer/jobs/verify_answer.h"
#include "renderer/jobs/verify_inputs.h"
#include "renderer/jobs/verify_picture.h"
#include "renderer/json/number_json.h"
#include "renderer/json/parse.h"
#include "renderer/plan/motion_page.h"
#include "renderer/verify/proof.h"
#include "renderer/verify/provable.h"

namespace minkray {
namespace {

struct VerifyOptions {
  CommandFiles* files = nullptr;
  VerifyInputs inputs;
  std::vector<std::string> plans, outputs;
  RefereeOptions referee;
  std::size_t budget = 4000;
  bool json = false, table = false, serve = false;
  int samples = 8, threads = 0;
};

/// Collisions take precedence over undecided motions.
ExitCode worse(ExitCode a, MotionStatus status) {
  if (a == ExitCode::comparison_failed || status == MotionStatus::collides)
    return ExitCode::comparison_failed;
  return status == MotionStatus::undecided ? ExitCode::undecided : a;
}

bool is_proof(const std::string& file) {
  return file.ends_with(".json");
}
bool is_page(const std::string& file) {
  return file.ends_with(".html");
}

void check_outputs(const VerifyOptions& options) {
  for (const std::string& file : options.outputs) {
    if (!is_proof(file) && !is_page(file) && !is_image_path(file))
      throw WrongUsage("-o: must end in .json (a proof), .html (a page) or " + image_extensions() +
                       " (a picture) (got " + file + ")");
    check_writable(file);
  }
  if (options.serve == !options.plans.empty())
    throw WrongUsage("verify: either --trajectory or --serve is required (not both)");
  if (!options.outputs.empty() && options.plans.size() != 1)
    throw WrongUsage("-o: must have one --trajectory (got " + std::to_string(options.plans.size()) +
                     ")");
}

/// A plan with its verdict.
struct Judged {
  std::string name;
  Plan plan;
  MotionVerdict verdict;
  double seconds = 0;
};

Judged judge(const std::string& name, Plan&& plan, const VerifyCell& cell,
             const VerifyOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  MotionVerdict verdict = verdict_of(plan.path, cell.cell.bodies, cell.cell.pairs, options.referee);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  return {name, std::move(plan), std::move(verdict), taken.count()};
}

Json json_of(const Judged& judged, const VerifyCell& cell) {
  Json json = verdict_json(judged.name, judged.verdict, judged.plan, cell.cell);
  json["seconds"] = number_json(judged.seconds);
  return json;
}

/// Returns the first line of the verdict's text, joined with the second line if there is one.
std::string title_of(const std::string& text) {
  const std::size_t first = text.find('\n'), second = text.find('\n', first + 1);
  if (second == text.npos) return text.substr(0, first);
  return text.substr(0, first) + ":" + text.substr(first + 2, second - first - 2);
}

void write_outputs(const VerifyOptions& options, const Judged& judged, const VerifyCell& cell) {
  const auto& [name, plan, verdict, seconds] = judged;
  const std::string text = verdict_text(name, verdict, plan, cell.cell);
  for (const std::string& file : options.outputs) {
    if (is_proof(file)) {
      ProofInputs inputs{std::string(version_and_commit()), cell.files};
      inputs.files.emplace_back(name);
      try {
        const Provable proof =
            provable(verdict, plan.path, cell.cell.bodies, cell.cell.pairs, options.referee);
        write_file(file, proof_text(proof, plan.path, inputs));
      } catch (const BadInput& error) {
        // Other verdicts already end with an exit code other than 0.
        if (verdict.status == MotionStatus::free) throw;
        std::cerr << error.what() << '\n';
      }
    } else if (is_page(file)) {
      WorstMoment worst = worst_moment(verdict);
      if (!worst.exists) worst.time = plan.path.times.front();
      ShownMotion shown{verdict_json(name, verdict, plan, cell.cell), text, worst.time,
                        plan.trajectory.has_times};
      if (worst.exists) shown.view = worst_view(verdict, plan, cell.cell);
      write_file(file, motion_page(cell.cell, plan.path, shown));
    } else {
      const Image image = worst_picture(verdict, plan, cell.cell, title_of(text), options.samples);
      write_file(file, encode_image(image, file));
    }
  }
}

/// A plan in the pipeline, from input to printed verdict.
struct Passing {
  std::string name, text;
  std::optional<Judged> judged;
  std::exception_ptr error;
};

/// Loads a plan with load() and judges it. Stores an error, to be printed when the plan's turn
/// comes.
template <class Load>
void judge(Passing& passing, const VerifyCell& cell, const VerifyOptions& options,
           const Load& load) {
  try {
    passing.judged = judge(passing.name, load(), cell, options);
  } catch (...) {
    passing.error = std::current_exception();
  }
}

/// Number of plans judged at once; verdicts are in the order of the plans.
std::size_t plans_at_once() {
  return static_cast<std::size_t>(std::max(thread_count(), 1));
}

/// Reads one plan per line and prints one verdict per line, or the error of an invalid plan.
void serve(const VerifyOptions& options, const VerifyCell& cell) {
  std::size_t number = 0;
  const auto read = [&]() -> std::shared_ptr<Passing> {
    for (std::string line; std::getline(std::cin, line);) {
      ++number;
      if (line.find_first_not_of(" \t\r") == line.npos) continue;
      return std::make_shared<Passing>(
          Passing{"line " + std::to_string(number), std::move(line), {}, {}});
    }
    return nullptr;
  };
  const auto work = [&](Passing& passing) {
    judge(passing, cell, options, [&] {
      // A line is a plan itself, or the quoted name of a file.
      const std::string& line = passing.text;
      if (line[line.find_first_not_of(" \t")] != '"') return parse_plan(line, passing.name, cell);
      Mistakes mistakes(passing.name);
      const std::optional<Json> file = parse_json(line, mistakes);
      throw_if_any(mistakes);
      return load_plan(file->text(), cell);
    });
  };
  const auto write_error = [](const std::string& name, const std::exception& error) {
    std::cout << Json{{"plan", name}, {"status", "error"}, {"message", error.what()}}.dump()
              << std::endl;
  };
  parallel_pipeline<Passing>(plans_at_once(), read, work, [&](Passing& passing) {
    try {
      if (passing.error) std::rethrow_exception(passing.error);
      std::cout << json_of(*passing.judged, cell).dump() << std::endl;
    } catch (const BadInput& error) {
      write_error(passing.name, error);
    } catch (const std::invalid_argument& error) {
      write_error(passing.name, error);
    }
  });
}

/// Prints the notes on files. Prints only the first few unless `all` is set: there may be hundreds.
void tell_notes(const std::vector<std::string>& notes, bool all) {
  constexpr std::size_t most = 3;
  for (std::size_t i = 0; i < notes.size() && (all || i < most); ++i)
    std::cerr << printable(notes[i]) << '\n';
  if (notes.size() > most && !all)
    std::cerr << "and " << notes.size() - most << " more notes (--verbose shows all)\n";
}

void verify(VerifyOptions& options, ExitCode& exit_code) {
  check_outputs(options);
  options.referee.budget = options.budget;
  options.referee.every_step = options.table;
  options.referee.keep_planes = std::ranges::any_of(options.outputs, is_proof);
  const VerifyCell cell = load_cell(options.inputs, *options.files);
  tell_notes(cell.notes, options.inputs.import.verbose);
  if (options.serve) return serve(options, cell);
  std::size_t next = 0;
  bool failed = false;
  const auto read = [&]() -> std::shared_ptr<Passing> {
    if (next == options.plans.size()) return nullptr;
    return std::make_shared<Passing>(Passing{options.plans[next++], {}, {}, {}});
  };
  const auto work = [&](Passing& passing) {
    judge(passing, cell, options, [&] { return load_plan(passing.name, cell); });
  };
  parallel_pipeline<Passing>(plans_at_once(), read, work, [&](Passing& passing) {
    if (passing.error) {
      if (options.plans.size() == 1) std::rethrow_exception(passing.error);
      try {
        std::rethrow_exception(passing.error);
      } catch (const BadInput& error) {
        std::cerr << error.what() << '\n';
        failed = true;
        return;
      }
    }
    const Judged& judged = *passing.judged;
    for (const std::string& note : judged.plan.trajectory.notes)
      std::cerr << judged.name << ": " << note << '\n';
    exit_code = worse(exit_code, judged.verdict.status);
    if (options.json)
      std::cout << json_of(judged, cell).dump() << '\n';
    else if (options.table)
      std::cout << steps_table(judged.verdict, judged.plan, cell.cell);
    else
      std::cout << verdict_text(judged.name, judged.verdict, judged.plan, cell.cell);
    write_outputs(options, judged, cell);
  });
  if (failed) throw BadInput("--trajectory: a plan could not be read; the others were verified");
}

}  // namespace

void add_verify(Parser& parser, ExitCode& exit_code) {
  const Verb verb = parser.add_verb("verify");
  const auto options = std::make_shared<VerifyOptions>();
  options->files = &verb.files();
  VerifyInputs& inputs = options->inputs;
  verb.add_option("--robot", inputs.robot, "Robot file:\n" + foreign_formats())
      .required()
      .reads_file();
  verb.add_option(
          "--trajectory", options->plans,
          "Planned motion: JointTrajectory, RobotTrajectory or MoveIt request (YAML, JSON), CSV "
          "or NPY; repeatable")
      .one_value_each()
      .reads_file();
  verb.add_option("-o,--output", options->outputs,
                  "Proof (.json), picture of the worst moment (.png) or page that plays the motion "
                  "(.html); repeatable")
      .one_value_each()
      .writes_file();
  verb.add_option("--scene", inputs.scenes,
                  "Obstacles: MoveIt planning scene (YAML, JSON), Minkray scene file or SDF world; "
                  "repeatable")
      .one_value_each()
      .reads_file();
  inputs.allowed.add_options(verb);
  verb.add_option(
          "--state", inputs.state,
          "Named state of the SRDF file that gives the values of joints missing from the plan")
      .takes("NAME");
  verb.add_option("--group", inputs.group,
                  "Group of the SRDF file whose joints are the columns of an NPY plan")
      .takes("NAME");
  verb.add_option("--padding", inputs.cell.padding,
                  "Distance in metres that links must keep from obstacles")
      .between(0.0, 1e6)
      .show_default();
  verb.add_option("--inflate", inputs.inflate,
                  "Padding of one link (m), instead of --padding; repeatable")
      .takes("LINK=RADIUS")
      .one_value_each();
  verb.add_flag("--only-obstacles", inputs.cell.only_obstacles,
                "Check the robot against obstacles only, not against itself (self-collision)");
  verb.add_option("--tolerance", options->referee.tolerance,
                  "Maximum gap between lower and upper bound of the clearance, relative to the "
                  "clearance")
      .between(1e-9, 1.0)
      .show_default();
  verb.add_option("--budget", options->budget,
                  "Maximum number of distance queries for each pair of bodies in each step\n"
                  "A step leads from one row of the plan to the next\n"
                  "If more queries are needed, the verdict is `undecided`")
      .between(std::size_t{1}, std::size_t{1'000'000'000})
      .show_default();
  verb.add_flag(
      "--serve", options->serve,
      "Read plans from stdin, one per line (a JSON message or a quoted file name); write one "
      "verdict per line to stdout");
  verb.add_option("-s,--samples", options->samples, "Samples per pixel of a picture")
      .between(1, 1 << 20)
      .show_default();
  verb.add_flag("--json", options->json, "Print one JSON object per plan");
  verb.add_flag("--table", options->table, "Print the minimum clearance of each step as CSV");
  add_import_options(verb, inputs.import, false);
  verb.add_option("-t,--threads", options->threads, "Threads; 0: one per core")
      .between(0, 1024)
      .show_default();
  verb.on_call([options, &exit_code] {
    with_threads(options->threads, [&] { verify(*options, exit_code); });
  });
}

}  // namespace minkray
