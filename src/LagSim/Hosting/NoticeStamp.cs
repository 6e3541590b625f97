using LagSim.Time;

namespace LagSim.Hosting;

/// <summary>What a notice is to the one who hears it, apart from what it is about.</summary>
internal readonly struct NoticeStamp
{
    internal NoticeStamp(NoticeKind kind, long number, long id, SimTime movedFrom)
    {
        Kind = kind;
        Number = number;
        Id = id;
        MovedFrom = movedFrom;
    }

    internal NoticeKind Kind { get; }

    /// <summary>Counts all notices, from 1.</summary>
    internal long Number { get; }

    /// <summary>The number of the notice that predicted it.</summary>
    internal long Id { get; }

    /// <summary>The instant that was told before.</summary>
    internal SimTime MovedFrom { get; }
}
