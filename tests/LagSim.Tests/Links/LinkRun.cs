using System.Linq;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Tests.Links;

/// <summary>Datagrams sent through one leg, one after another.</summary>
internal static class LinkRun
{
    internal const int DatagramBytes = 100;

    internal static (SimTime At, LinkDeliveries Arrives)[] Of(LinkLeg leg, ulong seed, SimDuration apart, int datagrams) =>
        Of(new LinkModel(leg, new SeededRandom(seed)), SimTime.Zero, apart, datagrams);

    internal static (SimTime At, LinkDeliveries Arrives)[] Of(LinkModel link, SimTime from, SimDuration apart, int datagrams)
    {
        var run = new (SimTime, LinkDeliveries)[datagrams];
        SimTime at = from;
        for (int i = 0; i < run.Length; i++, at += apart)
        {
            run[i] = (at, link.Send(at, DatagramBytes));
        }

        return run;
    }

    /// <summary>The delays in milliseconds of those that arrive, copies left out.</summary>
    internal static double[] Delays((SimTime At, LinkDeliveries Arrives)[] run) =>
        run.Where(sent => sent.Arrives.Count > 0).Select(sent => (sent.Arrives[0] - sent.At).ToMilliseconds()).ToArray();

    internal static ulong Fingerprint((SimTime At, LinkDeliveries Arrives)[] run)
    {
        ulong hash = 14695981039346656037;
        foreach ((SimTime _, LinkDeliveries arrives) in run)
        {
            hash = (hash ^ (ulong)arrives.Count) * 1099511628211;
            for (int i = 0; i < arrives.Count; i++)
            {
                hash = (hash ^ (ulong)arrives[i].Ticks) * 1099511628211;
            }
        }

        return hash;
    }
}
