using System;

namespace LagSim.Tests.Sessions;

/// <summary>Ways to keep a session together that are known to be wrong: negative controls.</summary>
[Flags]
internal enum SessionFault
{
    /// <summary>Nothing is wrong.</summary>
    None = 0,

    /// <summary>History goes by the own clock, as if whatever has not been heard of by then did not exist.</summary>
    ForgetsTooEarly = 1,

    /// <summary>Of several entries that go out in one update the second is left out.</summary>
    DropsWhenMerging = 2,

    /// <summary>Neither a queue nor a loss has a link send less.</summary>
    NeverBacksOff = 4,

    /// <summary>Every datagram that comes is taken for a round trip, also where it answers the one that the last has answered.</summary>
    CountsTripsAgain = 8,
}
