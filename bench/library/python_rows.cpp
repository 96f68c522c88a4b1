// SPDX-License-Identifier: MIT
// A million rays, and a million pairs of boxes, in one NumPy array, compared with the same in C++.
// Python runs as a child process and casts in turn with this one.
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "pairs.h"
#include "rays.h"
#include "sections.h"

namespace bench {
namespace {

constexpr std::size_t object_count = 100'000, ray_count = 1'000'000;
constexpr double goal = 0.85;

/// A folder that is removed at the end.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "library-bench-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("cannot make a folder: " + name);
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string operator/(const char* name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

template <class T>
void write(const std::string& file, const std::vector<T>& values) {
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(T)));
  if (!out.flush()) throw std::runtime_error("cannot write " + file);
}

template <class T>
std::vector<T> read(const std::string& file, std::size_t count) {
  std::vector<T> values(count);
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
  if (!in) throw std::runtime_error("cannot read " + file);
  return values;
}

/// The interpreter, with a socket for its input and output.
class Python : public Caster {
 public:
  Python(const std::string& interpreter, const char* script, const Folder& folder,
         std::size_t count)
      : Caster("Python"), folder_(folder), count_(count) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) throw std::runtime_error("no socket");
    child_ = fork();
    if (child_ < 0) throw std::runtime_error("cannot start " + interpreter);
    if (child_ == 0) {
      dup2(ends[1], STDIN_FILENO);
      dup2(ends[1], STDOUT_FILENO);
      close(ends[0]);
      close(ends[1]);
      execlp(interpreter.c_str(), interpreter.c_str(), script, folder.path().c_str(), nullptr);
      _exit(127);
    }
    close(ends[1]);
    socket_ = ends[0];
    if (line() != "ready") throw std::runtime_error("Python: could not make its scene");
  }
  ~Python() override { finish(); }
  Python(const Python&) = delete;
  Python& operator=(const Python&) = delete;

  void cast() override { timed_cast(); }
  double timed_cast() override {
    if (::write(socket_, "cast\n", 5) != 5) throw std::runtime_error("Python: ended");
    return 1e-9 * std::stod(line());
  }

 protected:
  /// Output that Python has written before it ended.
  template <class T>
  std::vector<T> result(const char* name_) const {
    finish();
    return read<T>(folder_ / name_, count_);
  }

 private:
  std::string line() {
    std::string text;
    for (char c = 0; ::read(socket_, &c, 1) == 1 && c != '\n';) text += c;
    if (text.empty()) throw std::runtime_error("Python: ended");
    return text;
  }
  void finish() const {
    if (child_ <= 0) return;
    shutdown(socket_, SHUT_WR);
    waitpid(child_, nullptr, 0);
    close(socket_);
    child_ = 0;
  }

  const Folder& folder_;
  std::size_t count_;
  mutable pid_t child_ = 0;
  int socket_ = -1;
};

class PythonRays : public Python {
 public:
  PythonRays(const std::string& interpreter, const Folder& folder, std::size_t rays)
      : Python(interpreter, PYTHON_RAYS, folder, rays) {}
  std::vector<Answer> answers() const override {
    const auto t = result<double>("t");
    const auto object = result<std::uint32_t>("object");
    std::vector<Answer> all;
    for (std::size_t i = 0; i < t.size(); ++i)
      all.push_back(object[i] == mk::no_object ? Answer{} : Answer{t[i], object[i]});
    return all;
  }
};

class PythonPairs : public Python {
 public:
  PythonPairs(const std::string& interpreter, const Folder& folder, std::size_t pairs)
      : Python(interpreter, PYTHON_PAIRS, folder, pairs) {}
  std::vector<Answer> answers() const override {
    std::vector<Answer> all;
    for (const double value : result<double>("value")) all.push_back({value, 0});
    return all;
  }
};

/// One call a pair.
class PairByPair : public Caster {
 public:
  PairByPair(const mk::Shape& shape, const std::vector<Meeting>& where)
      : Caster("mk::signed_distance, a pair a call"), shape_(shape), where_(where) {
    found_.resize(where.size());
  }
  void cast() override {
    for (std::size_t i = 0; i < where_.size(); ++i)
      found_[i] = mk::signed_distance(shape_, where_[i].a, shape_, where_[i].b);
  }
  std::vector<Answer> answers() const override {
    std::vector<Answer> all;
    for (const mk::Distance& found : found_) all.push_back({found.value, 0});
    return all;
  }

 private:
  const mk::Shape& shape_;
  const std::vector<Meeting>& where_;
  std::vector<mk::Distance> found_;
};

void measure_pairs(Table& table, const Options& options) {
  constexpr double pairs_goal = 1 / 1.2;
  Pair pair{"box, box", bullet_box({1, 0.5, 0.25}), bullet_box({1, 0.5, 0.25}), 0, 0};
  const std::vector<Meeting> where = meetings(pair, ray_count, true);
  const Folder folder;
  std::vector<mk::Pose> a, b;
  for (const Meeting& one : where) {
    a.push_back(one.a);
    b.push_back(one.b);
  }
  write(folder / "a", a);
  write(folder / "b", b);
  Casters python, cpp;
  python.push_back(std::make_unique<PythonPairs>(options.python, folder, where.size()));
  cpp.push_back(std::make_unique<PairByPair>(pair.a.ours.shape, where));
  race({&python, &cpp}, options.rounds);
  table.add(Duel{"Python, distances: box, box",
                 "one call, " + with_commas(where.size()),
                 *python[0],
                 *cpp[0],
                 "C++, ",
                 where.size(),
                 pairs_goal,
                 {0, 0}});
}

void measure(Table& table, const Options& options, bool coherent) {
  const Subject subject = make_subject("rounded boxes", object_count);
  const mk::Scene scene = scene_of(subject);
  // A picture's blocks have 8 x 8 pixels.
  std::vector<mk::Ray> rays = camera_rays(subject, 1000);
  if (!coherent) {
    std::vector<mk::Hit> hits(rays.size());
    scene.cast(rays, hits, {.threads = 1});
    rays = scattered_rays(subject, rays, hits, ray_count);
  }
  const Folder folder;
  std::vector<mk::Pose> poses;
  for (const Placed& object : subject.objects) poses.push_back(object.pose);
  write(folder / "poses", poses);
  std::vector<double> rows;
  for (const mk::Ray& ray : rays)
    for (const double x : {ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x,
                           ray.direction.y, ray.direction.z})
      rows.push_back(x);
  write(folder / "rays", rows);

  Casters python, cpp;
  python.push_back(std::make_unique<PythonRays>(options.python, folder, rays.size()));
  cpp.push_back(minkray_span(scene, rays, Question::first_hit));
  race({&python, &cpp}, options.rounds);
  table.add(Duel{"Python, " + with_commas(object_count) + " rounded boxes",
                 std::string(coherent ? "camera" : "scattered") + ", " + with_commas(rays.size()),
                 *python[0],
                 *cpp[0],
                 "C++, ",
                 rays.size(),
                 goal,
                 {0, 0}});
}

}  // namespace

std::vector<Section> python_sections() {
  std::vector<Section> sections;
  for (const bool coherent : {false, true})
    sections.push_back({std::string("Python, ") + (coherent ? "camera" : "scattered"),
                        [coherent](Table& table, const Options& options) {
                          if (!options.python.empty()) measure(table, options, coherent);
                        }});
  sections.push_back({"Python, pairs", [](Table& table, const Options& options) {
                        if (!options.python.empty()) measure_pairs(table, options);
                      }});
  return sections;
}

}  // namespace bench
