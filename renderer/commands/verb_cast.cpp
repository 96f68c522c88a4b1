// SPDX-License-Identifier: MIT
// minkray cast: answers a stream of queries, one JSON object per line in and out.
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <mutex>
#include <system_error>
#include <vector>

#include "core/parallel/parallel.h"
#include "core/parallel/parallel_pipeline.h"
#include "renderer/arguments/choices.h"
#include "renderer/arguments/tolerance_option.h"
#include "renderer/base/errors.h"
#include "renderer/cli/options.h"
#include "renderer/cli/verbs.h"
#include "renderer/jobs/scene_queries.h"
#include "renderer/paper/solvers.h"
#include "renderer/query/answer.h"
#include "renderer/query/query_json.h"

namespace minkray {
namespace {

/// Lines per batch: enough to hide the pipeline's own cost, few enough that results come early and
/// need little memory.
constexpr std::size_t lines_a_batch = 64;
/// Batches in progress per thread.
constexpr std::size_t batches_a_thread = 4;

/// Longer than a query with a hull of a million points, but limits the memory for files without
/// line ends.
constexpr std::size_t most_bytes_a_line = std::size_t{64} << 20;

struct CastVerbOptions {
  std::string file;
  std::string solver = "auto";
  std::string subalgorithm = "projection";
  double tolerance = AnswerOptions{}.tolerance;
  int threads = 0;
  bool trace = false;
  bool check = false;
  bool certify = false;
};

/// Number of results, by the outcome of their certificates.
struct CertificateCounts {
  std::size_t holding = 0, failing = 0, without = 0;

  CertificateCounts& operator+=(const CertificateCounts& other) {
    holding += other.holding;
    failing += other.failing;
    without += other.without;
    return *this;
  }
};

struct Line {
  std::string text;
  bool is_too_long = false;
};

struct Batch {
  std::size_t first_line = 0;
  std::vector<Line> lines;
  std::string out;
  std::string err;
  bool has_malformed = false;
  bool has_wrong = false;
  CertificateCounts certificates;
};

/// Mesh files that were read, for each batch that is processed at the same time as others.
class MeshPool {
 public:
  explicit MeshPool(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::unique_ptr<MeshFiles> take() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return std::make_unique<MeshFiles>(folder_);
    std::unique_ptr<MeshFiles> meshes = std::move(free_.back());
    free_.pop_back();
    return meshes;
  }
  void give_back(std::unique_ptr<MeshFiles> meshes) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(meshes));
  }

 private:
  const std::filesystem::path folder_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<MeshFiles>> free_;
};

/// Returns false at the end. Marks a line that is too long and drops its rest.
bool read_line(std::istream& in, Line& line) {
  using Traits = std::istream::traits_type;
  std::streambuf& buffer = *in.rdbuf();
  if (Traits::eq_int_type(buffer.sgetc(), Traits::eof())) return false;
  line = {};
  for (;;) {
    const auto next = buffer.sbumpc();
    if (Traits::eq_int_type(next, Traits::eof()) || next == '\n') return true;
    if (line.text.size() < most_bytes_a_line)
      line.text.push_back(Traits::to_char_type(next));
    else
      line.is_too_long = true;
  }
}

bool is_blank(std::string_view line) {
  return line.find_first_not_of(" \t\r") == std::string_view::npos;
}

/// Answers a query at a whole scene.
void answer_at_scene(const Line& line, const std::string& place, SceneQueries& scenes,
                     Batch& batch) {
  Mistakes mistakes(place);
  std::optional<Json> result;
  try {
    result = scenes.answer(line.text, mistakes);
  } catch (const std::runtime_error& error) {
    mistakes.add(std::string("cannot be answered: ") + error.what());
  }
  if (result) {
    batch.out += result->dump() + "\n";
    return;
  }
  batch.has_malformed = true;
  batch.err += mistakes.text() + "\n";
}

void answer_line(const Line& line, const std::string& place, MeshFiles& meshes,
                 const AnswerOptions& options, bool check, Batch& batch) {
  Mistakes mistakes(place);
  std::optional<Query> query;
  Answer result;
  try {
    if (line.is_too_long)
      mistakes.add("must not be longer than " + std::to_string(most_bytes_a_line) + " bytes");
    else
      query = parse_query(line.text, meshes, mistakes);
    if (query) result = answer(*query, options);
  } catch (const std::runtime_error& error) {
    // Continues with the other queries if one fails.
    query.reset();
    mistakes.add(std::string("cannot be answered: ") + error.what());
  }
  if (!query) {
    batch.has_malformed = true;
    batch.err += mistakes.text() + "\n";
    return;
  }
  batch.out += result.json.dump() + "\n";
  const std::string whose =
      printable(place) + (query->name.empty() ? "" : ": " + printable(query->name, 80));
  if (!result.verdict) {
    ++batch.certificates.without;
  } else if (result.verdict->holds) {
    ++batch.certificates.holding;
  } else {
    ++batch.certificates.failing;
    batch.err += whose + ": not certified: " + std::string(result.verdict->complaint) + "\n";
  }
  if (!check) return;
  for (const std::string& complaint : complaints(*query, result.facts)) {
    batch.has_wrong = true;
    batch.err += whose + ": " + complaint + "\n";
  }
}

ExitCode cast(const CastVerbOptions& options) {
  check_tolerance(options.tolerance);
  const AnswerOptions answer_options{kind_named(named_solvers, options.solver),
                                     kind_named(named_subalgorithms, options.subalgorithm),
                                     options.tolerance, options.trace, options.certify};

  std::ifstream file;
  if (options.file != "-") {
    std::error_code error;
    if (std::filesystem::is_directory(options.file, error))
      throw BadInput(options.file + ": must be a file (got a directory)");
    errno = 0;
    file.open(options.file, std::ios::binary);
    if (!file)
      throw BadInput(options.file + ": cannot be read: " + std::generic_category().message(errno));
  }
  std::istream& in = options.file == "-" ? std::cin : file;
  const std::string name = options.file == "-" ? "stdin" : options.file;
  const std::filesystem::path folder =
      options.file == "-" ? std::filesystem::path() : std::filesystem::path(name).parent_path();

  MeshPool pool(folder);
  SceneQueries scenes(folder);
  std::size_t next_line = 1;
  bool has_malformed = false, has_wrong = false;
  CertificateCounts certificates;

  const auto read = [&] {
    auto batch = std::make_shared<Batch>();
    batch->first_line = next_line;
    Line line;
    const auto next = [&] {
      try {
        return read_line(in, line);
      } catch (const std::ios_base::failure&) {
        throw BadInput(name + ": cannot be read to its end");
      }
    };
    while (batch->lines.size() < lines_a_batch && next()) {
      batch->lines.push_back(std::exchange(line, {}));
      // Input that arrives slowly is processed line by line.
      if (in.rdbuf()->in_avail() == 0 && options.file == "-") break;
    }
    next_line += batch->lines.size();
    return batch->lines.empty() ? nullptr : batch;
  };
  const auto solve = [&](Batch& batch) {
    std::unique_ptr<MeshFiles> meshes = pool.take();
    for (std::size_t i = 0; i < batch.lines.size(); ++i) {
      if (is_blank(batch.lines[i].text)) continue;
      const std::string place = name + ":" + std::to_string(batch.first_line + i);
      if (!batch.lines[i].is_too_long && SceneQueries::is_one(batch.lines[i].text))
        answer_at_scene(batch.lines[i], place, scenes, batch);
      else
        answer_line(batch.lines[i], place, *meshes, answer_options, options.check, batch);
    }
    pool.give_back(std::move(meshes));
  };
  const auto write = [&](const Batch& batch) {
    std::cout << batch.out;
    if (options.file == "-") std::cout.flush();
    if (!std::cout) throw CannotWrite("stdout: cannot be written");
    std::cerr << batch.err;
    has_malformed |= batch.has_malformed;
    has_wrong |= batch.has_wrong;
    certificates += batch.certificates;
  };
  parallel_pipeline<Batch>(static_cast<std::size_t>(thread_count()) * batches_a_thread, read, solve,
                           write);
  if (in.bad()) throw BadInput(name + ": cannot be read");
  if (options.certify)
    std::cerr << "certificates: " << certificates.holding << " hold, " << certificates.failing
              << " fail; " << certificates.without
              << " results have none (distances, shapes that turn, moving meshes)\n";
  has_wrong |= certificates.failing > 0;
  return has_malformed ? ExitCode::bad_input
                       : (has_wrong ? ExitCode::comparison_failed : ExitCode::done);
}

}  // namespace

void add_cast(Parser& parser, ExitCode& exit_code) {
  const Verb verb = parser.add_verb("cast");
  const auto options = std::make_shared<CastVerbOptions>();
  verb.add_option("file", options->file, "File of queries, one JSON object per line; - for stdin")
      .required()
      .reads_file();
  add_solver_option(verb, options->solver);
  verb.add_option("--subalgorithm", options->subalgorithm, "Distance subalgorithm of GJK")
      .one_of(names_in(named_subalgorithms))
      .show_default();
  add_tolerance(verb, options->tolerance);
  verb.add_option("-t,--threads", options->threads, "Threads; 0: one per core")
      .between(0, 1024)
      .show_default();
  verb.add_flag("--trace", options->trace, "Add every solver iteration to the results");
  verb.add_flag("--certify", options->certify,
                "Prove the result of every cast; exit with 1 if a proof fails");
  verb.add_flag(
      "--check", options->check,
      "Compare each result with the value \"expect\" in its query; exit with 1 on any difference");
  verb.on_call([options, &exit_code] {
    with_threads(options->threads, [&] { exit_code = cast(*options); });
  });
}

}  // namespace minkray
