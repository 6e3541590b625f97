using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Hosting;
using LagSim.Time;

namespace LagSim.Tests.Hosting;

/// <summary>The course of each notice of one kind that a game hears, held to the rules: fails with the first notice that breaks one.</summary>
/// <remarks>
/// Each is predicted once, then moved and doubted any number of times, each time from where it was told to be, and then confirmed as it was
/// told last, or retracted out of doubt. Nothing is predicted that something in doubt could have moved to: what is retracted does not happen.
/// </remarks>
internal sealed class NoticeCourses<T>
    where T : struct, INotice<T>
{
    private static readonly SimDuration near = SimDuration.FromSeconds(0.5);

    private readonly Func<T, NoticeStamp> stampOf;
    private readonly Dictionary<long, (T Last, bool IsInDoubt)> open = [];
    private readonly HashSet<long> over = [];
    private readonly List<T> predicted = []; // of this report
    private long number;

    internal NoticeCourses(Func<T, NoticeStamp> stampOf) => this.stampOf = stampOf;

    internal List<T> Confirmed { get; } = [];

    internal int Predicted { get; private set; }

    internal int Moved { get; private set; }

    internal int Doubted { get; private set; }

    internal int Retracted { get; private set; }

    internal int Open => open.Count;

    /// <summary>The first rule that was broken; null for none.</summary>
    internal string? Broken { get; private set; }

    internal void Take(T notice)
    {
        NoticeStamp stamp = stampOf(notice);
        bool isKnown = open.TryGetValue(stamp.Id, out (T Last, bool IsInDoubt) known);
        Check(stamp.Number == ++number, "is out of its turn", notice);
        Check(isKnown != (stamp.Kind == NoticeKind.Predicted) && !over.Contains(stamp.Id), "is not the first or a later one of its course", notice);
        Check(!isKnown || stamp.MovedFrom == known.Last.Key.Time, "moved from elsewhere", notice);
        bool saysTheSame = isKnown && notice.IsSameAs(known.Last);
        switch (stamp.Kind)
        {
            case NoticeKind.Predicted:
                Predicted++;
                Check(stamp.Id == stamp.Number && stamp.MovedFrom == notice.Key.Time, "is not the first of its course", notice);
                predicted.Add(notice);
                break;
            case NoticeKind.Moved:
                Moved++;
                Check(!saysTheSame || known.IsInDoubt, "moved nowhere", notice);
                Check(isKnown && known.Last.CompareSeries(notice) == 0, "moved to another series", notice);
                Check(isKnown && Distance(known.Last, notice) <= near, "moved too far", notice);
                break;
            case NoticeKind.InDoubt:
                Doubted++;
                Check(saysTheSame && !known.IsInDoubt, "was not told so, or is in doubt already", notice);
                break;
            case NoticeKind.Retracted:
                Retracted++;
                Check(saysTheSame && known.IsInDoubt, "was not in doubt", notice);
                break;
            case NoticeKind.Confirmed:
                Check(saysTheSame && !known.IsInDoubt, "was not told so", notice);
                Check(Confirmed.Count == 0 || Confirmed[^1].CompareWith(notice) < 0, "comes after a later one", notice);
                Confirmed.Add(notice);
                break;
            default:
                Check(false, "is of no kind", notice);
                break;
        }

        open[stamp.Id] = (notice, stamp.Kind == NoticeKind.InDoubt);
        if (stamp.Kind is NoticeKind.Confirmed or NoticeKind.Retracted)
        {
            open.Remove(stamp.Id);
            over.Add(stamp.Id);
        }
    }

    /// <summary>A report is complete: what it predicted is nothing that is still in doubt.</summary>
    internal void EndReport()
    {
        foreach (T one in predicted)
        {
            bool isOld = open.Values.Any(known => known.IsInDoubt && known.Last.CompareSeries(one) == 0 && Distance(known.Last, one) <= near);
            Check(!isOld, "was predicted beside one in doubt", one);
        }

        predicted.Clear();
    }

    private static SimDuration Distance(T a, T b) => a.Key.Time < b.Key.Time ? b.Key.Time - a.Key.Time : a.Key.Time - b.Key.Time;

    private void Check(bool isRight, string fault, T notice)
    {
        if (!isRight)
        {
            Broken ??= $"{notice}, number {stampOf(notice).Number} of {stampOf(notice).Id}, {fault}.";
        }
    }
}
