using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Time;

namespace AirHockey;

/// <summary>What one peer heard of its rules in a match: its own history of the score.</summary>
public sealed class PeerLog
{
    private readonly List<RuleEvent> confirmed = [];
    private readonly List<double> latencies = []; // of goals, in ms
    public PeerLog() => Notices.Noticed += Take;

    /// <summary>What a session is given.</summary>
    public RuleNotices Notices { get; } = new();

    /// <summary>The session, once it is known.</summary>
    public Session? Session { get; set; }

    /// <summary>What was confirmed, in order.</summary>
    public IReadOnlyList<RuleEvent> Confirmed => confirmed;

    public IEnumerable<RuleEvent> Goals => confirmed.Where(told => told.Notice.Code == (int)Told.Goal);

    /// <summary>How long after each goal it was confirmed here, in milliseconds.</summary>
    public IReadOnlyList<double> Latencies => latencies;

    /// <summary>Goals that were predicted and did not happen, since a late event came before them.</summary>
    public int GoalsTakenBack { get; private set; }

    /// <summary>Predictions that were neither confirmed nor taken back; none once a match has ended for a while.</summary>
    public int Open { get; private set; }

    /// <summary>Whether this peer was told the same as another: the same things at the same ticks in the same order, each once.</summary>
    public bool IsSameAs(PeerLog other) =>
        confirmed.Count == other.confirmed.Count && confirmed.Zip(other.confirmed).All(pair => pair.First.IsSameNotice(pair.Second));

    /// <summary>Whether nothing was confirmed twice.</summary>
    public bool IsEachOnce => confirmed.Select(told => (told.Key, told.Place)).Distinct().Count() == confirmed.Count;

    /// <summary>A hash (FNV-1a) of every confirmed notice: its tick, what it is and its value.</summary>
    public ulong Hash(SimTime start)
    {
        ulong hash = 14695981039346656037;
        foreach (RuleEvent told in confirmed)
        {
            foreach (long part in (long[])[(told.Time - start).Ticks, told.Notice.Code, told.Notice.Value])
            {
                for (int shift = 0; shift < 64; shift += 8)
                {
                    hash = (hash ^ (byte)(part >> shift)) * 1099511628211;
                }
            }
        }

        return hash;
    }

    private void Take(RuleEvent told)
    {
        bool isGoal = told.Notice.Code == (int)Told.Goal;
        Open += told.Kind switch { NoticeKind.Predicted => 1, NoticeKind.Confirmed or NoticeKind.Retracted or NoticeKind.Unresolved => -1, _ => 0 };
        GoalsTakenBack += isGoal && told.Kind == NoticeKind.Retracted ? 1 : 0;
        if (told.Kind == NoticeKind.Confirmed)
        {
            confirmed.Add(told);
            if (isGoal && Session is not null)
            {
                latencies.Add((Session.SharedTime.Now - told.Time).ToMilliseconds());
            }
        }
    }
}
