/* What functions refuse. */
{%- for refusal in h.refusals %}
#define {{ h.upper }}_REFUSED_{{ refusal.name }} {{ loop.index }} /* {{ refusal.what }} */
{%- endfor %}

/* Stands for no index, and the characters of an explanation. */
#define {{ h.upper }}_NO_INDEX UINT32_MAX
#define {{ h.upper }}_EXPLANATION 160

/* Details of a refusal: 0 or one of {{ h.upper }}_REFUSED_..., the index of what was refused, what was found, and from where to where it is
 * expected; the codes from {{ h.upper }}_REFUSED_{{ h.unexpected }} on expect nothing in particular. */
struct {{ h.prefix }}{{ h.base }}_refusal {
  int code;
  uint32_t index;
  int64_t found;
  int64_t least;
  int64_t most;
};

/* A compiler that can warns of a return code that nobody looks at. */
#ifndef {{ h.upper }}_CHECKED
#if defined(__GNUC__)
#define {{ h.upper }}_CHECKED __attribute__((warn_unused_result))
#else
#define {{ h.upper }}_CHECKED
#endif
#endif

/* Notes a refusal where the caller wants to know it. */
static inline int {{ h.prefix }}{{ h.base }}_refuse(struct {{ h.prefix }}{{ h.base }}_refusal *why, int code, uint32_t index, int64_t found, int64_t least,
    int64_t most)
{
  if (why) {
    why->code = code;
    why->index = index;
    why->found = found;
    why->least = least;
    why->most = most;
  }
  return code;
}

/* The same unless a number is inside its range. */
static inline int {{ h.prefix }}{{ h.base }}_range(struct {{ h.prefix }}{{ h.base }}_refusal *why, int code, uint32_t index, int64_t found, int64_t least,
    int64_t most)
{
  return {{ h.prefix }}{{ h.base }}_refuse(why, least <= found && found <= most ? 0 : code, index, found, least, most);
}

static inline char *{{ h.prefix }}{{ h.base }}_say(char *end, const char *text)
{
  while (*text)
    *end++ = *text++;
  return end;
}

static inline char *{{ h.prefix }}{{ h.base }}_say_number(char *end, int64_t number, int is_signed)
{
  char digits[20];
  unsigned count = 0;
  const int negative = is_signed && number < 0;
  uint64_t rest = negative ? 0 - (uint64_t)number : (uint64_t)number;
  do {
    digits[count++] = (char)('0' + (int)(rest % 10));
    rest /= 10;
  } while (rest > 0);
  if (negative)
    *end++ = '-';
  while (count)
    *end++ = digits[--count];
  return end;
}

/* A refusal in words, as "coordinate 3: found 5; expected -4 to 4"; returns `text`. */
static inline const char *{{ h.prefix }}{{ h.base }}_explain(const struct {{ h.prefix }}{{ h.base }}_refusal *why, char text[{{ h.upper }}_EXPLANATION])
{
  static const char *const names[] = {"nothing is refused"{% for refusal in h.refusals %}, "{{ refusal.what }}"{% endfor %}};
  const int known = why->code > 0 && why->code < (int)(sizeof names / sizeof *names);
  const int is_signed = why->code < {{ h.upper }}_REFUSED_{{ h.unsigned }};
  char *end = {{ h.prefix }}{{ h.base }}_say(text, names[known ? why->code : 0]);
  if (known) {
    if (why->index != {{ h.upper }}_NO_INDEX) {
      end = {{ h.prefix }}{{ h.base }}_say(end, " ");
      end = {{ h.prefix }}{{ h.base }}_say_number(end, why->index, 0);
    }
    end = {{ h.prefix }}{{ h.base }}_say(end, ": found ");
    end = {{ h.prefix }}{{ h.base }}_say_number(end, why->found, is_signed);
    if (why->code < {{ h.upper }}_REFUSED_{{ h.unexpected }}) {
      end = {{ h.prefix }}{{ h.base }}_say(end, "; expected ");
      end = {{ h.prefix }}{{ h.base }}_say_number(end, why->least, is_signed);
    }
    if (why->code < {{ h.upper }}_REFUSED_{{ h.unexpected }} && why->least != why->most) {
      end = {{ h.prefix }}{{ h.base }}_say(end, " to ");
      end = {{ h.prefix }}{{ h.base }}_say_number(end, why->most, is_signed);
    }
  }
  *end = 0;
  return text;
}
