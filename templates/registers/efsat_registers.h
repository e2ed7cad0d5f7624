{% for line in header -%}
/* {{ line }} */
{% endfor -%}
/*
 * The registers of {{ prefix }}efsat_shell in C99 and C++: addresses in bytes from their base, bits of fields as shift and mask, values after
 * reset; and functions that send and receive words of packets, which {{ prefix }}{{ host }} packs and unpacks.
 *
 * Every access is one aligned read or write of 32 bits. The default takes `base` for the address of memory that the bus does not cache
 * and does not read ahead; define {{ upper }}_READ(base, offset) and {{ upper }}_WRITE(base, offset, value) first to access the
 * registers in another way. An access that the hardware refuses ends as the processor treats an error of its bus, so the functions
 * look first and make none.
 */
#ifndef {{ upper }}_H
#define {{ upper }}_H

#include <stddef.h>
#include <stdint.h>
{% for register in registers %}
/* {{ register.access }}{% if register.what.len() > 0 %}: {{ register.what }}{% endif %} */
#define {{ upper }}_{{ register.upper }} 0x{{ register.at }}
#define {{ upper }}_{{ register.upper }}_RESET UINT32_C(0x{{ register.reset }})
{%- for field in register.fields %}
#define {{ upper }}_{{ register.upper }}_{{ field.upper }}_SHIFT {{ field.low }}{% if field.what.len() > 0 %} /* {{ field.what }} */{% endif %}
#define {{ upper }}_{{ register.upper }}_{{ field.upper }}_MASK UINT32_C(0x{{ field.mask }})
{%- endfor %}
{% endfor %}
/* Why an access is refused: {{ upper }}_REFUSAL_WHY. */
{%- for refusal in refusals %}
#define {{ upper }}_REFUSED_{{ refusal.upper }} {{ refusal.code }} /* {{ refusal.what }} */
{%- endfor %}

#ifndef {{ upper }}_READ
#define {{ upper }}_READ(base, offset) (*(volatile const uint32_t *)((uintptr_t)(base) + (offset)))
#define {{ upper }}_WRITE(base, offset, value) ((void)(*(volatile uint32_t *)((uintptr_t)(base) + (offset)) = (value)))
#endif

/* A field of the value of a register. */
#define {{ upper }}_FIELD(value, name) (((value) & {{ upper }}_##name##_MASK) >> {{ upper }}_##name##_SHIFT)

/* Whether the design is the one that this file was generated with: 1 if it is. */
static inline int {{ prefix }}efsat_registers_fit(uintptr_t base)
{
  return {{ upper }}_READ(base, {{ upper }}_IDENTITY) == {{ upper }}_IDENTITY_RESET
      && {{ upper }}_READ(base, {{ upper }}_VERSION) == {{ upper }}_VERSION_RESET
      && {{ upper }}_READ(base, {{ upper }}_PARAMETERS) == {{ upper }}_PARAMETERS_RESET
      && {{ upper }}_READ(base, {{ upper }}_CORE) == {{ upper }}_CORE_RESET;
}

/* A soft reset; the core takes words after it if `enable` is not 0. */
static inline void {{ prefix }}efsat_registers_reset(uintptr_t base, int enable)
{
  {{ upper }}_WRITE(base, {{ upper }}_CONTROL, {{ upper }}_CONTROL_SOFT_RESET_MASK | (enable ? {{ upper }}_CONTROL_ENABLE_MASK : 0));
}

/* Writes as many of `size` bytes, which are whole words of a packet, 8 bytes each, as the queue has places for; the last of them ends
 * the packet if `ends` is not 0. Returns how many bytes were written: call it again with the rest. */
static inline size_t {{ prefix }}efsat_registers_send(uintptr_t base, const uint8_t *bytes, size_t size, int ends)
{
  uint32_t level = {{ upper }}_FIELD({{ upper }}_READ(base, {{ upper }}_STATUS), STATUS_TRANSMIT_LEVEL);
  uint32_t places = {{ upper }}_FIELD({{ upper }}_CORE_RESET, CORE_TRANSMIT_PLACES) - level;
  size_t done = 0;
  for (; size - done >= 8 && places > 0; places--, done += 8) {
    uint32_t half[2] = {0, 0};
    for (unsigned i = 0; i < 8; i++)
      half[i / 4] |= (uint32_t)bytes[done + i] << (8 * (i % 4));
    {{ upper }}_WRITE(base, {{ upper }}_TRANSMIT_LOW, half[0]);
    if (ends && size - done == 8)
      {{ upper }}_WRITE(base, {{ upper }}_TRANSMIT_LAST, half[1]);
    else
      {{ upper }}_WRITE(base, {{ upper }}_TRANSMIT_HIGH, half[1]);
  }
  return done;
}

/* Reads words of an answer, {{ answer_bytes }} bytes each, as many as are there and as `size` bytes hold, and no further than to the last of a packet,
 * for which it sets `*ended` to 1, else to 0. Returns how many bytes were read. */
static inline size_t {{ prefix }}efsat_registers_receive(uintptr_t base, uint8_t *bytes, size_t size, int *ended)
{
  size_t done = 0;
  *ended = 0;
  while (!*ended && size - done >= {{ answer_bytes }}) {
    uint32_t half[2], status = {{ upper }}_READ(base, {{ upper }}_STATUS);
    if ({{ upper }}_FIELD(status, STATUS_RECEIVE_LEVEL) == 0)
      break;
    *ended = (int){{ upper }}_FIELD(status, STATUS_RECEIVE_LAST);
    half[0] = {{ upper }}_READ(base, {{ upper }}_RECEIVE_LOW);
    half[1] = {{ upper }}_READ(base, {{ upper }}_RECEIVE_HIGH);
    for (unsigned i = 0; i < {{ answer_bytes }}; i++)
      bytes[done++] = (uint8_t)(half[i / 4] >> (8 * (i % 4)));
  }
  return done;
}

#endif
