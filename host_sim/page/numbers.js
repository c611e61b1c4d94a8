// Numbers as people read them. They are real text with an ASCII minus, so that they can be pasted.
"use strict";

const Numbers = (() => {
  const none = "–";

  function known(x) {
    return typeof x === "number" && Number.isFinite(x);
  }

  // Without an exponent where that is readable.
  function significant(x, digits = 4) {
    if (!known(x)) return none;
    const size = Math.abs(x);
    if (size !== 0 && (size < 1e-4 || size >= 1e7)) {
      return x.toExponential(digits - 1).replace(/\.?0+e/, "e").replace("e+", "e");
    }
    return String(Number(x.toPrecision(digits)));
  }

  function percent(share) {
    if (share > 0 && share < 1e-5) return "< 0.001 %";
    return known(share) ? significant(100 * share, 3) + " %" : none;
  }

  // Nothing is certain: not even what is 1 to all digits.
  function probability(p) {
    if (!known(p)) return none;
    if (p > 0.999) return "> 99.9 %";
    if (p < 0.001) return "< 0.1 %";
    return significant(100 * p, 3) + " %";
  }

  // As many digits as the uncertainty warrants: two of it.
  function withStd(value, std) {
    if (!known(value)) return none;
    if (!known(std) || std <= 0) return significant(value, 6);
    const size = Math.max(Math.abs(value), std);
    if (size < 1e-3 || size >= 1e6) return scientific(value, std);
    const decimals = Math.min(12, 1 - Math.floor(Math.log10(std)));
    return rounded(value, decimals) + " ± " + rounded(std, decimals);
  }

  // Fewer than no decimals: whole tens, hundreds.
  function rounded(value, decimals) {
    if (decimals >= 0) return value.toFixed(decimals);
    const unit = Math.pow(10, -decimals);
    return String(Math.round(value / unit) * unit);
  }

  function scientific(value, std) {
    const power = Math.floor(Math.log10(Math.max(Math.abs(value), std)));
    const unit = Math.pow(10, power);
    const decimals = Math.min(8, Math.max(0, 1 - Math.floor(Math.log10(std / unit))));
    return `(${(value / unit).toFixed(decimals)} ± ${(std / unit).toFixed(decimals)})e${power}`;
  }

  // An instant or a duration, to what a window of `span` seconds can show.
  function seconds(t, span = 1) {
    const decimals = Math.min(6, Math.max(0, 2 - Math.floor(Math.log10(span || 1))));
    return t.toFixed(decimals);
  }

  function bytes(n) {
    if (!known(n)) return none;
    if (n < 1e3) return n + " B";
    return n < 1e6 ? significant(n / 1e3, 3) + " kB" : significant(n / 1e6, 3) + " MB";
  }

  // A number without unit has the unit 1.
  function unit(u) {
    return u === "1" || !u ? "" : u;
  }

  return {none, known, significant, percent, probability, withStd, seconds, bytes, unit};
})();
