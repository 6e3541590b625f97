using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;

namespace LagSim.Harness.Reports.Charts;

/// <summary>
/// A log10 axis, of whole decades or as long as its values need. Values below its lowest one are on a separate line at the bottom, labelled
/// <c>0</c>.
/// </summary>
internal sealed class LogAxis : Axis
{
    /// <summary>The most decades, the number of digits of a double: more would hide the larger values.</summary>
    private const int MaxDecades = 18;

    private const double ZeroLine = 9.0; // above the frame, so that a curve of zeros does not hide in it
    private const double ZeroBand = 26.0; // from the frame to the lowest decade
    private readonly double _low; // logarithms
    private readonly double _high;
    private readonly double _bottom;
    private readonly List<AxisTick> _ticks = [];

    public LogAxis(ValueRange range, double length, double pixelsPerTick, bool roundOut, double? floor, double inset)
        : base(length, inset)
    {
        bool anyPositive = range.MinPositive <= range.Max;
        double low = floor ?? (anyPositive ? range.MinPositive : 1e-3);
        double high = Math.Max(anyPositive ? range.Max : 1.0, low);
        if (roundOut)
        {
            _high = Math.Ceiling(Math.Log10(high) - 1e-9);
            _low = Math.Max(Math.Floor(Math.Log10(low) + 1e-9), _high - MaxDecades);
            _high = Math.Max(_high, _low + 1);
        }
        else
        {
            _high = Math.Log10(high);
            _low = Math.Max(Math.Log10(low), _high - MaxDecades);
            double missing = Math.Max(0, 1 - (_high - _low)); // a decade has labels at 1, 2 or 5 at least twice
            (_low, _high) = (_low - (0.5 * missing), _high + (0.5 * missing));
        }

        bool positiveBelow = anyPositive && range.MinPositive < Lowest;
        bool below = positiveBelow || (!range.IsEmpty && range.Min <= 0.0);
        _bottom = below ? Math.Max(ZeroBand, inset) : inset;
        if (below)
        {
            // Values that only round to zero at this scale are not labelled zero.
            _ticks.Add(new AxisTick(ZeroLine, positiveBelow ? "<" + Label((int)Math.Ceiling(_low - 1e-9), 1) : "0"));
        }

        AddDecades(pixelsPerTick);
    }

    public override IReadOnlyList<AxisTick> Ticks => _ticks;

    private double Lowest => Math.Pow(10.0, _low) * (1.0 - 1e-9);

    public override double Map(double value) => value < Lowest
        ? ZeroLine
        : _bottom + (Span * Math.Max(0.0, Math.Log10(value) - _low) / (_high - _low));

    private double Span => Length - Inset - _bottom;

    private void AddDecades(double pixelsPerTick)
    {
        double decade = Span / (_high - _low);
        int every = new[] { 1, 2, 3, 5, 10, 20, 50, 100 }.FirstOrDefault(n => n * decade >= 0.7 * pixelsPerTick, 200);
        for (int exponent = (int)Math.Floor(_low); exponent <= _high + 1e-9; exponent++)
        {
            AddTick(exponent, 1, exponent % every == 0);
            for (int digit = 2; digit <= 9 && decade >= 1.4 * pixelsPerTick; digit++)
            {
                AddTick(exponent, digit, digit is 2 or 5 && decade >= 3.4 * pixelsPerTick);
            }
        }
    }

    private void AddTick(int exponent, int digit, bool isLabelled)
    {
        double value = digit * Math.Pow(10.0, exponent), log = Math.Log10(value);
        if (log >= _low - 1e-9 && log <= _high + 1e-9)
        {
            _ticks.Add(new AxisTick(Map(value), isLabelled ? Label(exponent, digit) : null));
        }
    }

    /// <summary>Formats plain numbers on a short axis, and powers of ten where one would not fit; never a mixture.</summary>
    private string Label(int exponent, int digit)
    {
        if (_low >= -4 && _high <= 4)
        {
            return (digit * Math.Pow(10.0, exponent)).ToString("0.####", CultureInfo.InvariantCulture);
        }

        string power = "10" + string.Concat(exponent.ToString(CultureInfo.InvariantCulture).Select(Superscript));
        return digit == 1 ? power : digit.ToString(CultureInfo.InvariantCulture) + "\u00d7" + power;
    }

    private static char Superscript(char c) => c == '-' ? '\u207b' : "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"[c - '0'];
}
