// {% for line in header %}{{ line }} {% endfor %}
//
// Testbench of a netlist of the engine for Verilator: the lines of the VHDL testbench's file, all at full speed.
// Arguments: the file{% if e.axi %}, the least and the most clocks of latency of memory{% endif %}.

#include "V{{ prefix }}efsat_engine.h"
#include "verilated.h"
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

struct Word {
    uint64_t data;
    bool last, whole;
    char kind;  // I, D or W
};
struct Packet {
    std::vector<uint64_t> pairs;
    uint32_t low;
    int mode;
    uint64_t counts[3];
};
struct Burst {
    uint64_t due;
    size_t address;
    unsigned beats;
};

static uint64_t failures = 0;

static void complain(size_t packet, const char *what, uint64_t expected, uint64_t actual) {
    if (++failures <= 10) {
        std::printf("efsat_engine_tb: packet %zu: %s expected %016llx actual %016llx\n", packet, what,
                    (unsigned long long)expected, (unsigned long long)actual);
    }
}

static void compare(size_t number, const Packet &due, std::vector<uint64_t> found) {
    if (found.size() < 8) {
        complain(number, "words of a report", 8, found.size());
        return;
    }
    std::vector<uint64_t> tail(found.end() - 8, found.end());
    found.resize(found.size() - 8);
    if (uint32_t(tail[0]) != due.low) complain(number, "word 0", due.low, uint32_t(tail[0]));
    for (int i = 0; i < 3; i++) {
        if (due.mode == 2 && tail[i + 1] != due.counts[i]) complain(number, "a count", due.counts[i], tail[i + 1]);
    }
    if ((tail[7] >> 32 & 0xffff) > {{ e.stack }}) complain(number, "entries of the stack", {{ e.stack }}, tail[7] >> 32 & 0xffff);
    std::sort(found.begin(), found.end());
    bool fine = due.mode == 2 ? found == due.pairs
              : due.mode == 1 ? std::includes(due.pairs.begin(), due.pairs.end(), found.begin(), found.end())
                              : true;
    if (!fine) complain(number, "pairs", due.pairs.size(), found.size());
}

int main(int argc, char **argv) {
    std::ifstream file(argv[1]);
    std::string text;
    std::getline(file, text);
    if (text != "{{ e.formats }}") {
        std::printf("efsat_engine_tb: %s is for another design\n", argv[1]);
        return 1;
    }
    std::vector<Word> words;
    std::vector<Packet> packets;
    std::vector<uint64_t> memory;
    Packet next = {};
    while (std::getline(file, text)) {
        std::istringstream line(text);
        char kind;
        line >> kind >> std::hex;
        if (kind == 'I') {
            Word word = {0, false, false, 'I'};
            line >> word.data >> word.last >> word.whole;
            words.push_back(word);
        } else if (kind == 'D' || kind == 'W') {
            Word word = {0, false, false, kind};
            if (kind == 'D') line >> word.data;
            words.push_back(word);
        } else if (kind == 'M') {
            uint64_t address, word;
            line >> address >> word;
            memory.resize(std::max<size_t>(memory.size(), address + 1));
            memory[address] = word;
        } else if (kind == 'A') {
            uint64_t pair;
            line >> pair;
            next.pairs.push_back(pair);
        } else if (kind == 'R') {
            line >> next.low >> next.mode >> next.counts[0] >> next.counts[1] >> next.counts[2];
            packets.push_back(next);
            next = {};
        }
    }
{%- if e.axi %}
    uint64_t least = std::strtoull(argv[2], nullptr, 10), most = std::strtoull(argv[3], nullptr, 10);
    std::deque<Burst> bursts;
    unsigned beat = 0;
    uint64_t random = 88172645463325252ull, words_read = 0;
{%- endif %}
    VerilatedContext context;
    V{{ prefix }}efsat_engine top(&context);
    top.aclk = 0;
    top.aresetn = 0;
    top.s_axis_tvalid = 0;
    top.m_axis_tready = 1;
    auto clock = [&] {
        top.aclk = 0;
        top.eval();
        top.aclk = 1;
        top.eval();
    };
    for (int i = 0; i < 4; i++) clock();
    top.aresetn = 1;
    size_t place = 0, packets_in = 0, packets_out = 0, pairs = 0;
    uint64_t total = 0, busy = 0, quiet = 0, pause = 0, greatest = 0;
    uint64_t sums[8] = {};
    std::vector<uint64_t> found;
    bool offered = false;
    while (packets_out < packets.size() && quiet < {{ e.patience }}) {
        // What stands at the ports before the edge.
        top.aclk = 0;
        top.eval();
        bool word_taken = offered && top.s_axis_tready;
        bool answer = top.m_axis_tvalid && top.m_axis_tready;
        uint64_t data = top.m_axis_tdata;
        bool last = top.m_axis_tlast;
{%- if e.axi %}
        bool asked = top.m_axi_arvalid && top.m_axi_arready;
        size_t address = top.m_axi_araddr / 8;
        unsigned beats = top.m_axi_arlen + 1u;
        if (asked && (top.m_axi_araddr % 64 != 0 || {{ e.memory_bytes }} * beats > 64 || address + beats * {{ e.memory_bytes }} / 8 > memory.size())) {
            complain(packets_out, "an address", memory.size(), address);
        }
{%- endif %}
        top.aclk = 1;
        top.eval();
        total++;
        quiet++;
        if (answer) {
            quiet = 0;
            found.push_back(data);
            if (last) {
                if (found.size() >= 8) {
                    size_t report = found.size() - 8;
                    pairs += report;
                    busy += found[report] >> 32;
                    greatest = std::max<uint64_t>(greatest, found[report + 7] >> 32 & 0xffff);
                    for (int i = 1; i < 8; i++) sums[i] += found[report + i] & 0xffffffff;
                    sums[0] += found[report + 6] >> 32;
                }
                compare(packets_out, packets[packets_out], found);
                packets_out++;
                found.clear();
            }
        }
        if (word_taken) {
            quiet = 0;
            offered = false;
            packets_in += words[place].last && uint32_t(words[place].data) != 0x{{ e.stop_header }}u;
            place++;
        }
        if (!offered && place < words.size()) {
            const Word &word = words[place];
            if (pause > 0) {
                pause--;
            } else if (word.kind == 'D') {
                pause = word.data;
                place++;
            } else if (word.kind == 'W') {
                place += packets_out == packets_in;
            } else {
                top.s_axis_tdata = word.data;
                top.s_axis_tlast = word.last;
                top.s_axis_tkeep = word.whole ? 0xff : 0x7f;
                offered = true;
            }
        }
        top.s_axis_tvalid = offered;
{%- if e.axi %}
        // Memory: bursts in order, each not before its latency is over.
        if (asked) {
            random ^= random << 13;
            random ^= random >> 7;
            random ^= random << 17;
            bursts.push_back({total + least - 1 + random % (most - least + 1), address, beats});
        }
        top.m_axi_arready = 1;
        top.m_axi_rvalid = 0;
        top.m_axi_rlast = 0;
        top.m_axi_rresp = 0;
        if (!bursts.empty() && bursts.front().due <= total) {
            const Burst &burst = bursts.front();
            words_read++;
            top.m_axi_rvalid = 1;
            unsigned char bytes[{{ e.memory_bytes }}];
            size_t from = 8 * burst.address + {{ e.memory_bytes }} * beat;
            for (int i = 0; i < {{ e.memory_bytes }}; i++) {
                bytes[i] = (from + i) / 8 < memory.size() ? memory[(from + i) / 8] >> 8 * ((from + i) % 8) : 0;
            }
            std::memcpy(&top.m_axi_rdata, bytes, {{ e.memory_bytes }});
            if (++beat == burst.beats) {
                top.m_axi_rlast = 1;
                beat = 0;
                bursts.pop_front();
            }
        }
{%- endif %}
    }
    if (packets_out < packets.size()) complain(packets_out, "packets", packets.size(), packets_out);
    std::printf("efsat_engine_tb: packets %zu pairs %zu mismatches %llu stack %llu clocks %llu total %llu expansions %llu leaf-pairs %llu words %llu starved %llu stalled %llu\n",
                packets_out, pairs, (unsigned long long)failures, (unsigned long long)greatest, (unsigned long long)busy,
                (unsigned long long)total, (unsigned long long)sums[1], (unsigned long long)sums[2],
                (unsigned long long)sums[6], (unsigned long long)sums[0], (unsigned long long)sums[7]);
    return failures > 0;
}
