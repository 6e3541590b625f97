using System;
using System.Collections.Generic;
using System.Globalization;

namespace LagSim.Harness.Reports.Charts;

/// <summary>A linear axis with ticks at 1, 2 or 5 times a power of ten.</summary>
internal sealed class LinearAxis : Axis
{
    private readonly double _low;
    private readonly double _high;
    private readonly List<AxisTick> _ticks = [];

    public LinearAxis(ValueRange range, double length, double pixelsPerTick, bool roundOut, double inset)
        : base(length, inset)
    {
        (_low, _high) = range.IsEmpty ? (0.0, 1.0) : (range.Min, range.Max);
        if (roundOut && _low > 0.0 && _low < 0.5 * _high)
        {
            _low = 0.0; // a curve that comes near zero is read against zero
        }

        // A span that is tiny compared with the values would give ticks with equal labels.
        double least = Math.Max(Math.Abs(_low), Math.Abs(_high)) * 1e-9;
        if (!(_high - _low > least))
        {
            double pad = Math.Max(0.5 * Math.Max(Math.Abs(_low), Math.Abs(_high)) * (roundOut ? 1e-1 : 1e-3), least);
            pad = pad > 0.0 ? pad : 0.5;
            (_low, _high) = (_low - pad, _high + pad);
        }

        double step = NiceStep((_high - _low) / Math.Max(2.0, Math.Floor(length / pixelsPerTick)));
        double below = Math.Floor(_low / step) * step, above = Math.Ceiling(_high / step) * step;
        double slack = roundOut ? step : 0.02 * (_high - _low); // x follows its data unless a tick is close by
        _low = _low - below <= slack ? below : _low;
        _high = above - _high <= slack ? above : _high;

        double first = Math.Ceiling((_low / step) - 1e-6);
        for (int i = 0; i < 100 && (first + i) * step <= _high + (1e-6 * step); i++)
        {
            double value = (first + i) * step;
            _ticks.Add(new AxisTick(Map(value), Label(value, step, Math.Max(Math.Abs(_low), Math.Abs(_high)))));
        }
    }

    public override IReadOnlyList<AxisTick> Ticks => _ticks;

    public override double Map(double value) => Inset + ((value - _low) / (_high - _low) * (Length - (2 * Inset)));

    private static double NiceStep(double least)
    {
        double power = Math.Pow(10.0, Math.Floor(Math.Log10(least)));
        double mantissa = least / power;
        return power * (mantissa <= 1.0 + 1e-9 ? 1.0 : mantissa <= 2.0 + 1e-9 ? 2.0 : mantissa <= 5.0 + 1e-9 ? 5.0 : 10.0);
    }

    private static string Label(double value, double step, double largest)
    {
        if (Math.Abs(value) < step * 1e-6)
        {
            return "0";
        }

        int decimals = Math.Max(0, -(int)Math.Floor(Math.Log10(step) + 1e-9));
        if (decimals <= 5 && largest < 1e7)
        {
            return value.ToString("F" + decimals.ToString(CultureInfo.InvariantCulture), CultureInfo.InvariantCulture).Replace('-', '\u2212');
        }

        // As many digits as distinguish neighbouring ticks.
        int digits = Math.Clamp((int)Math.Ceiling(Math.Log10(largest / step)) + 1, 1, 12);
        string format = "0." + new string('#', digits) + "e0";
        return value.ToString(format, CultureInfo.InvariantCulture).Replace('-', '\u2212');
    }
}
