// Runs packets through a netlist of the engine.
{%- for line in header %}
// {{ line }}
{%- endfor %}
//
// Arguments: three files of 64-bit words, little-endian: memory from address 0; steps, each its kind, its length and its words:
// 0 a packet, 1 clocks to pass, 2 a soft reset by the port, 3 words of a packet that goes on, 4 until all is answered, 5 a copy of
// engine and memory goes on with so many of the steps that follow, which are left out here; answers, to be written, each the clock
// of its last word, its length and its words. Then{% if axi %} the least and the most clocks from
// an address to its first word,{% endif %} 1 for gaps on all sides or 0, and a seed.
#include "V{{ top }}.h"
#include "verilated.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

namespace {

const uint64_t line_bytes = 64;
{%- if axi %}
const uint64_t word_bytes = {{ word_bytes }};  // of memory
const size_t most_bursts = 64;
{%- endif %}

uint64_t clock_now = 0;

[[noreturn]] void fail(const std::string &message) {
  std::printf("error: clock %llu: %s\n", static_cast<unsigned long long>(clock_now), message.c_str());
  std::exit(1);
}

uint64_t number(const char *text) { return std::strtoull(text, nullptr, 10); }

std::vector<uint64_t> read_words(const std::string &name) {
  std::ifstream file(name, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file || bytes.size() % 8 != 0)
    fail("cannot read " + name);
  std::vector<uint64_t> words(bytes.size() / 8);
  std::memcpy(words.data(), bytes.data(), bytes.size());
  return words;
}

class Random {
public:
  explicit Random(uint64_t seed) : state(seed * 2 + 88172645463325253ull) {}

  // Below the bound.
  uint64_t operator()(uint64_t bound) {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return (state >> 16) % bound;
  }

private:
  uint64_t state;
};

enum Kind { whole_packet, pass_clocks, reset_port, begin_packet, wait_answers, go_apart };

struct Step {
  Kind kind;
  std::vector<uint64_t> words;
  bool order(uint64_t header) const { return kind == whole_packet && words.size() == 1 && (words[0] & 0xffffffffff) == header; }
  bool stops() const { return order(0x{{ stop_header }}); }
  bool resets() const { return kind == reset_port || order(0x{{ reset_header }}); }
  bool sends() const { return kind == whole_packet || kind == begin_packet; }
};

std::vector<Step> read_steps(const std::string &name) {
  const std::vector<uint64_t> words = read_words(name);
  std::vector<Step> steps;
  for (size_t i = 0; i < words.size(); i += 2 + words[i + 1]) {
    if (words.size() - i < 2 || words[i] > go_apart || words[i + 1] > words.size() - i - 2)
      fail(name + " is no list of steps");
    const auto first = words.begin() + i + 2;
    steps.push_back({Kind(words[i]), std::vector<uint64_t>(first, first + words[i + 1])});
  }
  return steps;
}

// Signals that stay as they are from when they are offered until they are taken.
template <typename Value> class Steady {
public:
  explicit Steady(const char *name) : name(name) {}

  void see(bool valid, bool ready, const Value &value) {
    if (held && (!valid || value != last))
      fail(std::string(name) + " changed before it was taken");
    held = valid && !ready;
    last = value;
  }

private:
  const char *name;
  bool held = false;
  Value last{};
};

struct Offer {
  uint64_t data;
  bool last;
  bool operator!=(const Offer &other) const { return data != other.data || last != other.last; }
};
{%- if axi %}

struct Address {
  uint64_t byte;
  unsigned beats;
  bool operator!=(const Address &other) const { return byte != other.byte || beats != other.beats; }
};

// The signals of a read port.
struct Port {
{%- for signal in port_signals %}
  decltype(V{{ top }}::m{{ ports[0] }}_axi_{{ signal }}) &{{ signal }};
{%- endfor %}
};

// One channel of memory, in order.
class Memory {
public:
  Memory(const Port &port, const std::vector<uint64_t> &words, const std::vector<Step> &steps, uint64_t least, uint64_t most, bool gaps, uint64_t seed)
      : port(port), words(words), readable(words.size() * 8 / line_bytes), least(least), most(most), gaps(gaps), random(seed) {
    // What may be read: the ranges of queries.
    for (const Step &step : steps) {
      if (step.words.size() < 5 || uint32_t(step.words[0]) != 0x{{ query_header }})
        continue;
      for (int part = 0; part < {% if by_number %}2{% else %}4{% endif %}; part++) {
        const auto half = [&](int place) { return step.words[place + part / 2] >> (part % 2 ? 32 : 0) & 0xffffffff; };
        for (uint64_t i = half(1); i < half(1) + half({% if by_number %}2{% else %}3{% endif %}) && i < readable.size(); i++)
          readable[i] = true;
      }
    }
  }

  // Before the rising edge: what the engine asks, and whether it takes what is offered.
  void see() {
    asked = port.arvalid && port.arready;
    address = {port.araddr, port.arlen + 1u};
    steady.see(port.arvalid, port.arready, address);
    if (!port.rready)
      fail("RREADY is not set");
    if (!asked)
      return;
    const uint64_t bytes = address.beats * word_bytes, line = address.byte / line_bytes;
    if (port.arcache != 3 || port.arprot != 0)
      fail("another kind of access");
    if (port.arburst != 1 || port.arsize != {{ word_size }})
      fail("a burst that is not of whole words one after the other");
    if (address.byte % line_bytes != 0 || bytes > line_bytes || address.byte % 4096 + bytes > 4096)
      fail("a burst of " + std::to_string(bytes) + " bytes at byte " + std::to_string(address.byte));
    if (line >= readable.size() || !readable[line])
      fail("a read outside the trees of the queries, at byte " + std::to_string(address.byte));
    if (bursts.size() == most_bursts)
      fail("too many bursts");
  }

  // After it.
  void drive() {
    if (asked)
      bursts.push_back({address, clock_now + least - 1 + random(most - least + 1)});
    // A memory may wait for an address before it is ready; who offers one must not wait for that.
    port.arready = !gaps || (port.arvalid && random(4) > 0);
    port.rvalid = 0;
    port.rlast = 0;
    port.rresp = 0;
    if (bursts.empty() || bursts.front().due > clock_now || (gaps && random(4) == 0))
      return;
    const Address &burst = bursts.front().address;
    std::memcpy(&port.rdata, reinterpret_cast<const char *>(words.data()) + burst.byte + beat * word_bytes, word_bytes);
    port.rvalid = 1;
    if (++beat == burst.beats) {
      port.rlast = 1;
      beat = 0;
      bursts.pop_front();
    }
  }

private:
  struct Burst {
    Address address;
    uint64_t due;
  };
  Port port;
  const std::vector<uint64_t> &words;
  std::vector<bool> readable;  // lines
  uint64_t least, most;
  bool gaps;
  Random random;
  std::deque<Burst> bursts;
  unsigned beat = 0;
  bool asked = false;
  Address address{};
  Steady<Address> steady{"an address"};
};
{%- endif %}

}  // namespace

int main(int argc, char **argv) {
  if (argc != {{ arguments }})
    fail("wrong arguments");
  const std::vector<Step> steps = read_steps(argv[2]);
  std::ofstream answers(argv[3], std::ios::binary);
  const auto write = [&](const uint64_t *words, size_t count) {
    answers.write(reinterpret_cast<const char *>(words), static_cast<std::streamsize>(8 * count));
  };
  const bool gaps = number(argv[argc - 3]) != 0;
  const uint64_t seed = number(argv[argc - 2]);
  const uint64_t patience = number(argv[argc - 1]);  // clocks without a transfer before giving up
  Random random(seed + 1);
  const auto context = std::make_unique<VerilatedContext>();
  const auto top = std::make_unique<V{{ top }}>(context.get());
{%- if axi %}
  // No reset of the engine is one of memory: what was asked for is answered.
  const std::vector<uint64_t> words = read_words(argv[1]);
  std::vector<Memory> memories;
{%- for port in ports %}
  memories.emplace_back(Port{ {%- for signal in port_signals %}{% if !loop.first %}, {% endif %}top->m{{ port }}_axi_{{ signal }}{% endfor -%} }, words, steps, number(argv[4]), number(argv[5]), gaps, seed{% if !loop.first %} + {{ loop.index0 }}{% endif %});
{%- endfor %}
{%- endif %}
  const auto edge = [&] {
    top->aclk = 1;
    top->eval();
  };
  const auto settle = [&] {
    top->aclk = 0;
    top->eval();
  };
  top->aresetn = 0;
  for (int i = 0; i < {{ reset_clocks }}; i++) {
    settle();
    edge();
  }
  settle();
  if (top->s_axis_tready || top->m_axis_tvalid)
    fail("a handshake in reset");
  top->aresetn = 1;
  top->s_axis_tkeep = 0xff;
  top->m_axis_tready = 1;
  settle();

  Steady<Offer> steady("an answer");
  std::vector<uint64_t> answer;
  // Packets sent that are to be answered, those up to the last soft reset, and those that are answered.
  size_t sent = 0, sent_before = 0, answered = 0;
  size_t step = 0, word = 0, end = steps.size();
  uint64_t quiet = 0, passed = 0;
  bool in_packet = false, is_copy = false;
  while (step < end || answered < sent) {
    const bool takes = top->s_axis_tvalid && top->s_axis_tready;
    const bool gives = top->m_axis_tvalid && top->m_axis_tready;
    const Offer offer = {top->m_axis_tdata, top->m_axis_tlast != 0};
    steady.see(top->m_axis_tvalid, top->m_axis_tready, offer);
{%- if axi %}
    for (Memory &memory : memories)
      memory.see();
{%- endif %}
    edge();
    clock_now++;
    quiet = takes || gives ? 0 : quiet + 1;
    if (quiet > patience)
      fail("no transfer any more");
    if (gives) {
      answer.push_back(offer.data);
      if (offer.last) {
        const uint64_t head[] = {clock_now, answer.size()};
        write(head, 2);
        write(answer.data(), answer.size());
        // A report with reason 10 is the answer to all before it.
        const bool reset = answer.size() >= 8 && (answer[answer.size() - 8] & 0xff) == 0xab;
        answered = reset ? sent_before : answered + 1;
        answer.clear();
      }
    }
    if (takes) {
      top->s_axis_tvalid = 0;
      passed = 0;
      if (++word == steps[step].words.size()) {
        const Step &done = steps[step++];
        word = 0;
        in_packet = done.kind == begin_packet;
        sent += !in_packet && !done.stops();
        if (done.resets())
          sent_before = sent;
      }
    }
    top->soft_reset = 0;
    if (!top->s_axis_tvalid && step < end) {
      const Step &next = steps[step];
      if (next.sends()) {
        if (!gaps || random(2) == 0) {
          top->s_axis_tvalid = 1;
          top->s_axis_tdata = next.words[word];
          top->s_axis_tlast = next.kind == whole_packet && word + 1 == next.words.size();
        }
      } else if (next.kind == pass_clocks) {
        quiet = 0;
        if (passed++ >= next.words[0]) {
          step++;
          passed = 0;
        }
      } else if (next.kind == reset_port) {
        top->soft_reset = 1;
        step++;
        // The rest of a packet is dropped: the report stands for it, too.
        sent += !in_packet;
        sent_before = sent + in_packet;
      } else if (next.kind == go_apart) {
        quiet = 0;
        // What was written before is written once, and by one after the other.
        answers.flush();
        std::fflush(stdout);
        const pid_t copy = fork();
        int status = 0;
        if (copy < 0 || (copy > 0 && waitpid(copy, &status, 0) != copy))
          fail("no copy of the engine");
        // It has said why.
        if (status != 0)
          std::_Exit(1);
        const size_t behind = step + 1 + next.words[0];
        if (copy == 0) {
          is_copy = true;
          end = behind;
        }
        step = is_copy ? step + 1 : behind;
      } else if (answered == sent) {
        step++;
      }
    }
    top->m_axis_tready = !gaps || random(4) > 0;
{%- if axi %}
    for (Memory &memory : memories)
      memory.drive();
{%- endif %}
    settle();
  }
  top->final();
  answers.flush();
  if (!answers)
    fail("cannot write " + std::string(argv[3]));
  if (is_copy)
    std::_Exit(0);
  std::printf("%llu clocks\n", static_cast<unsigned long long>(clock_now));
  return 0;
}
