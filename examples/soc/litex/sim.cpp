// The system in Verilator: what its serial line says, up to the line "end". The clocks that it took go to standard error.
#include "Vsoc.h"
#include "verilated.h"
#include <cstdio>
#include <string>

int main(int argc, char **argv)
{
  const long most = 200000000;
  Verilated::commandArgs(argc, argv);
  Vsoc soc;
  std::string line;
  soc.serial_source_ready = 1;
  soc.serial_sink_valid = 0;
  for (long clock = 0; clock < most; clock++) {
    soc.reset = clock < 32;
    soc.clock = 0;
    soc.eval();
    const bool says = soc.serial_source_valid && !soc.reset;
    const char c = static_cast<char>(soc.serial_source_data);
    soc.clock = 1;
    soc.eval();
    if (!says)
      continue;
    line += c;
    if (c != '\n')
      continue;
    std::fputs(line.c_str(), stdout);
    if (line == "end\n") {
      std::fprintf(stderr, "%ld clocks\n", clock);
      return 0;
    }
    line.clear();
  }
  std::fprintf(stderr, "error: no end after %ld clocks\n", most);
  return 1;
}
