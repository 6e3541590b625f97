using System;
using System.Runtime.InteropServices.JavaScript;
using System.Runtime.Versioning;

namespace LagSim.Play.Browser;

/// <summary>The numbers of a frame, as the page's <c>frame.mjs</c> reads them: the time, then for each pane some about it and some about each of
/// its bodies.</summary>
/// <remarks>The memory is kept from frame to frame. For the page's one thread.</remarks>
[SupportedOSPlatform("browser")]
internal sealed partial class FrameWriter
{
    private const int NumbersPerPane = 7;
    private const int NumbersPerBody = 7;

    private double[] numbers = [];
    private int at;

    /// <summary>Begins a frame of so many panes with so many bodies in each.</summary>
    internal void Begin(int panes, int bodies, double seconds)
    {
        int length = 1 + (panes * (NumbersPerPane + (bodies * NumbersPerBody)));
        if (numbers.Length != length)
        {
            numbers = new double[length];
        }

        numbers[0] = seconds;
        at = 1;
    }

    /// <summary>Writes what is told of a pane. The error is in metres, the traffic in bytes.</summary>
    internal void WritePane(double error, long heals, long eventsRerun, long bodiesRewound, long sent, long received, bool isHolding)
    {
        Write(error);
        Write(heals);
        Write(eventsRerun);
        Write(bodiesRewound);
        Write(sent);
        Write(received);
        Write(isHolding ? 1 : 0);
    }

    /// <summary>Writes where a body of the pane is.</summary>
    internal void WriteBody(in DrawnPlace place)
    {
        Write(place.IsThere ? 1 : 0);
        Write(place.Drawn.X);
        Write(place.Drawn.Y);
        Write(place.Real.X);
        Write(place.Real.Y);
        Write(place.Glow);
        Write(place.IsInHand ? 1 : 0);
    }

    /// <summary>Gives the frame to the page.</summary>
    internal void Show() => TakeFrame(numbers);

    [JSImport("takeFrame", "page")]
    private static partial void TakeFrame([JSMarshalAs<JSType.MemoryView>] Span<double> frame);

    private void Write(double number) => numbers[at++] = number;
}
