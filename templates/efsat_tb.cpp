// Testbench of efsat for Verilator: the clocked process of efsat_tb.vhd, statement by statement, with the same vectors,
// the same two passes and the same lines of output. Simulation has two states: nothing is ever unknown here.
{%- for line in header %}
// {{ line }}
{%- endfor %}
#include "Vefsat.h"
#include "verilated.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace {

const char *const formats = "{{ formats }}";
const uint64_t paced = {{ paced }};        // pairs of the second pass
const uint64_t patience = {{ patience }};     // clocks without an answer before giving up
const uint64_t in_flight = 4096;  // answers awaited at most
const uint64_t full_after = {{ full_after }};   // clocks of refusal after which the unit is full

// A word of the vector file: 64 bits an entry, the lowest first.
using Word = std::vector<uint64_t>;

[[noreturn]] void fail(const std::string &message) {
  std::printf("error: efsat_tb: %s\n", message.c_str());
  std::exit(1);
}

Word read_word(const std::string &digits) {
  Word word(digits.size() / 16 + 1, 0);
  size_t place = 0;
  for (size_t i = digits.size(); i-- > 0; place++) {
    const char c = digits[i];
    uint64_t nibble = 0;
    if (c >= '0' && c <= '9')
      nibble = c - '0';
    else if (c >= 'a' && c <= 'f')
      nibble = c - 'a' + 10;
    else
      fail(std::string("no hexadecimal digit: ") + c);
    word[place / 16] |= nibble << (4 * (place % 16));
  }
  return word;
}

uint64_t mask(unsigned bits) { return bits >= 64 ? ~uint64_t(0) : (uint64_t(1) << bits) - 1; }

uint64_t field(const Word &word, unsigned low, unsigned bits) {
  uint64_t value = word[low / 64] >> (low % 64);
  if (low % 64 + bits > 64)
    value |= word[low / 64 + 1] << (64 - low % 64);
  return value & mask(bits);
}

std::string hex(uint64_t value, unsigned bits) {
  char text[20];
  std::snprintf(text, sizeof text, "%0*llx", int((bits + 3) / 4), static_cast<unsigned long long>(value));
  return text;
}

void drive_pair(Vefsat &unit, const Word &word) {
{%- for field in pair %}
  unit.{{ field.port }} = field(word, {{ field.low }}, {{ field.bits }});
{%- endfor %}
}
{%- if pose.len() > 0 %}

void drive_pose(Vefsat &unit, const Word &word) {
{%- for field in pose %}
  unit.{{ field.port }} = field(word, {{ field.low }}, {{ field.bits }});
{%- endfor %}
}
{%- endif %}

uint64_t answer_of(const Vefsat &unit) {
  uint64_t answer = 0;
{%- for field in answer %}
  answer |= static_cast<uint64_t>(unit.{{ field.port }}) << {{ field.low }};
{%- endfor %}
  return answer;
}

// The records of a vector file, one by one.
class Records {
public:
  char kind = '.';  // of the record at hand; '.' is none
  std::string words[2];

  explicit Records(const std::string &name) : source(name) {
    std::string line;
    if (!source || !std::getline(source, line))
      fail("cannot read " + name);
    if (line != formats)
      fail(name + " is for another design: " + line + " instead of " + formats);
    next();
  }

  void next() {
    kind = '.';
    std::string line;
    while (std::getline(source, line)) {
      if (line.size() < 3 || line[0] == '#')
        continue;
      kind = line[0];
      const size_t gap = line.find(' ', 2);
      words[0] = line.substr(2, gap == std::string::npos ? gap : gap - 2);
      words[1] = gap == std::string::npos ? "" : line.substr(gap + 1);
      break;
    }
  }

private:
  std::ifstream source;
};

}  // namespace

int main(int argc, char **argv) {
  const std::string vectors = argc > 1 ? argv[1] : "efsat_tb.vec";
  const auto context = std::make_unique<VerilatedContext>();
  const auto unit = std::make_unique<Vefsat>(context.get());
  std::vector<std::string> pairs(in_flight);
  std::vector<uint64_t> answers(in_flight);
  uint64_t clock = 0, quiet = 0, mismatches = 0, vectors_seen = 0, offered = 0, taken = 0;
  uint64_t interval = 0, latency = 0, clocks = 0, waited = 0;
  int64_t first_accepted = -1, previous_accepted = -1;
  uint16_t random = 0xace1;
  bool filled = false;

  // The rising edge; inputs for the next clock are given after it.
  const auto edge = [&] {
    unit->clk = 1;
    unit->eval();
  };
  const auto settle = [&] {
    unit->clk = 0;
    unit->eval();
  };
  unit->reset = 1;
  settle();
  for (int i = 0; i < {{ reset_clocks }}; i++) {
    edge();
    settle();
  }
  unit->reset = 0;
  settle();
  for (int pass = 1; pass <= 2; pass++) {
    Records records(vectors);
    offered = 0;
    taken = 0;
    for (;;) {
      const bool in_valid = unit->in_valid, accepted = in_valid && unit->in_ready;
      const bool takes = unit->out_valid && unit->out_ready;
{%- if pose.len() > 0 %}
      const bool pose_valid = unit->pose_valid, posed = pose_valid && unit->pose_ready;
{%- endif %}
      quiet++;
      if (takes) {
        quiet = 0;
        const uint64_t answer = answer_of(*unit), expected = answers[taken % in_flight];
{%- if tag_width > 0 %}
        const bool tag_fits = unit->out_tag == (taken + 1) % {{ tags }};
{%- else %}
        const bool tag_fits = true;
{%- endif %}
        if (answer != expected || !tag_fits) {
          mismatches++;
          if (mismatches <= 10)
            std::printf("efsat_tb: mismatch at vector %llu pass %d pair %s expected %s actual %s%s\n",
                        static_cast<unsigned long long>(taken), pass, pairs[taken % in_flight].c_str(),
                        hex(expected, {{ answer_bits }}).c_str(), hex(answer, {{ answer_bits }}).c_str(),
                        tag_fits ? "" : " with a wrong tag");
        }
        if (pass == 1) {
          if (taken == 0)
            latency = clock - first_accepted;
          clocks = clock - first_accepted;
        }
        taken++;
      }
      edge();
      if (accepted) {
        unit->in_valid = 0;
        if (pass == 1) {
          const int64_t now = clock;
          if (previous_accepted < 0)
            first_accepted = now;
          else if (interval == 0 || now - previous_accepted < int64_t(interval))
            interval = now - previous_accepted;
          previous_accepted = now;
        }
      }
{%- if pose.len() > 0 %}
      if (posed)
        unit->pose_valid = 0;
{%- endif %}
      // Pace: full speed; in the second pass no answer is taken until the unit is full, then all is random.
      const auto bit = [&](int i) { return (random >> i) & 1; };
      random = uint16_t(random << 1 | (bit(15) ^ bit(13) ^ bit(12) ^ bit(10)));
      waited = in_valid && !accepted ? waited + 1 : 0;
      bool go = true;
      unit->out_ready = pass == 1;
      if (pass == 2 && !filled) {
        filled = waited > full_after || (!in_valid && (records.kind == '.' || offered == paced));
      } else if (pass == 2) {
        go = (random & 15) == 0 || (bit(0) && clock / 256 % 2 == 1);
        unit->out_ready = bit(4);
      }
      // The next record, once the one before is accepted.
      bool done = false;
      if (go && (!in_valid || accepted)
{%- if pose.len() > 0 %} && (!pose_valid || posed)
{%- endif %} && records.kind != '.' && (pass == 1 || offered < paced)) {
        if (records.kind == 'V') {
          drive_pair(*unit, read_word(records.words[0]));
          pairs[offered % in_flight] = records.words[0];
          answers[offered % in_flight] = read_word(records.words[1])[0];
{%- if tag_width > 0 %}
          // From 1 on, as what was never written is 0.
          unit->in_tag = (offered + 1) % {{ tags }};
{%- endif %}
          unit->in_valid = 1;
          offered++;
{%- if pose.len() > 0 %}
        } else if (records.kind == 'P') {
          drive_pose(*unit, read_word(records.words[0]));
          unit->pose_valid = 1;
{%- endif %}
        } else {
          fail(std::string("no record: ") + records.kind);
        }
        records.next();
      } else if (taken == offered && (records.kind == '.' || (pass == 2 && offered == paced))) {
        done = true;
      }
      settle();
      clock++;
      if (done)
        break;
      if (quiet > patience)
        fail("no answer any more");
    }
    quiet = 0;
    if (pass == 1)
      vectors_seen = taken;
  }
  const auto number = [](uint64_t x) { return static_cast<unsigned long long>(x); };
  std::printf("efsat_tb: vectors %llu mismatches %llu clocks %llu latency %llu interval %llu paced %llu total %llu\n",
              number(vectors_seen), number(mismatches), number(clocks), number(latency), number(interval),
              number(taken), number(clock));
  if (mismatches > 0)
    std::printf("Error: efsat_tb: the unit and the reference model differ\n");
  if (interval != 0 && interval != {{ interval }})
    std::printf("Error: efsat_tb: initiation interval is not {{ interval }}\n");
  if (latency {% if two_stages %}<{% else %}!={% endif %} {{ latency }})
    std::printf("Error: efsat_tb: latency is not {{ latency }}\n");
  unit->final();
  return 0;
}
