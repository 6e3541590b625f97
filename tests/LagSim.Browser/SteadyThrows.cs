using System.Diagnostics;
using System.Threading.Tasks;

namespace LagSim.Browser;

/// <summary>A person who throws a ball every half second, in one pane after another: what the page is measured under.</summary>
/// <param name="page">The page; all its panes have to be in sight.</param>
/// <param name="panes">How many it has.</param>
/// <param name="balls">How many balls are in each.</param>
internal sealed class SteadyThrows(OpenedPage page, int panes, int balls)
{
    private const double EverySeconds = 0.5;

    /// <summary>How many were thrown so far.</summary>
    internal int Count { get; private set; }

    /// <summary>Throws for so long. Where the browser is too slow for two a second there are fewer; <see cref="Count"/> tells.</summary>
    internal async Task GoOnAsync(double seconds)
    {
        Stopwatch passed = Stopwatch.StartNew();
        for (double next = 0; next < seconds; next += EverySeconds)
        {
            if (passed.Elapsed.TotalSeconds > next + EverySeconds)
            {
                continue; // too late for this one
            }

            float early = (float)((next - passed.Elapsed.TotalSeconds) * 1000);
            if (early > 0)
            {
                await page.Page.WaitForTimeoutAsync(early);
            }

            int n = Count++;
            await page.ThrowAsync(n % panes, n * 5 % balls, (n % 3 - 1) * 60, -40 - (n % 4 * 15));
        }
    }
}
