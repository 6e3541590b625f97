using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Rules;
using LagSim.Tests.Hosting;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Rules;

/// <summary>What one world's rules told, as a game hears it: fails if a notice breaks its course.</summary>
internal sealed class RuleEvents
{
    private readonly NoticeCourses<RuleEvent> courses = new(n => new NoticeStamp(n.Kind, n.Number, n.Id, n.MovedFrom));

    internal RuleEvents() => Notices.Noticed += Take;

    internal RuleNotices Notices { get; } = new();

    internal List<(EventKey Key, int Place, RuleNotice Notice)> Confirmed { get; } = [];

    internal List<RuleEvent> All { get; } = [];

    internal int Predicted => courses.Predicted;

    internal int Moved => courses.Moved;

    internal int Retracted => courses.Retracted;

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
        courses.Take(told);
        Assert.Null(courses.Broken);
        if (told.Kind == NoticeKind.Confirmed)
        {
            Confirmed.Add((told.Key, told.Place, told.Notice));
        }
    }
}
