using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Rules;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Rules;

/// <summary>What one world's rules told, as a game hears it: fails if something is confirmed or retracted that was not predicted, or twice.</summary>
internal sealed class RuleEvents
{
    private readonly HashSet<(EventKey Key, int Place, RuleNotice Notice)> open = [];

    internal RuleEvents() => Notices.Noticed += Take;

    internal RuleNotices Notices { get; } = new();

    internal List<(EventKey Key, int Place, RuleNotice Notice)> Confirmed { get; } = [];

    internal List<RuleEvent> All { get; } = [];

    internal int Predicted { get; private set; }

    internal int Retracted { get; private set; }

    /// <summary>What the rules of a world told that kept everything, in order.</summary>
    internal static List<(EventKey Key, int Place, RuleNotice Notice)> Of(Simulation world)
    {
        List<(EventKey Key, int Place, RuleNotice Notice)> told = [];
        RuleLog log = world.Engine.Rules!;
        for (int n = 0; n < log.Position; n++)
        {
            int place = told.Count(one => one.Key == log[n].Key);
            told.AddRange(log[n].Notices.Select((notice, at) => (log[n].Key, place + at, notice)));
        }

        return told;
    }

    /// <summary>Those of them before a time.</summary>
    internal static IEnumerable<(EventKey Key, int Place, RuleNotice Notice)> Of(Simulation world, SimTime before) =>
        Of(world).Where(one => one.Key.Time < before);

    private void Take(RuleEvent told)
    {
        All.Add(told);
        Assert.Equal(All.Count, told.Number);
        (EventKey Key, int Place, RuleNotice Notice) what = (told.Key, told.Place, told.Notice);
        if (told.Kind == NoticeKind.Predicted)
        {
            Predicted++;
            Assert.True(open.Add(what), $"{told} was predicted already");
            return;
        }

        Assert.True(open.Remove(what), $"{told} was not predicted, or came before");
        Retracted += told.Kind == NoticeKind.Retracted ? 1 : 0;
        if (told.Kind == NoticeKind.Confirmed)
        {
            Confirmed.Add(what);
        }
    }
}
