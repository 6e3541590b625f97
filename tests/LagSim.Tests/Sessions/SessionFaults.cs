using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Time;

namespace LagSim.Tests.Sessions;

/// <summary>Puts a wrong part into a session in the place of a right one, before its first step.</summary>
internal static class SessionFaults
{
    internal static void Put(this Session session, SessionFault fault)
    {
        SessionParts parts = session.Parts;
        parts.Links.Parts = new FaultyParts(fault);
        if (fault.HasFlag(SessionFault.ForgetsTooEarly))
        {
            parts.Commits.WatermarkRule = watermark => SimTime.Max(watermark, parts.SharedTime.Now - parts.Options.Window.History);
        }
    }

    /// <summary>Has each world that the session makes be made of other parts.</summary>
    internal static void Put(this Session session, EngineParts parts) =>
        session.Parts.World.ChangeOptions(options => options.WithParts(parts));

    private sealed class FaultyParts(SessionFault fault) : LinkParts
    {
        internal override SendWindow Window(uint acknowledged) =>
            fault.HasFlag(SessionFault.DropsWhenMerging) ? new DroppingWindow(acknowledged) : base.Window(acknowledged);

        internal override CongestionControl Congestion() =>
            fault.HasFlag(SessionFault.NeverBacksOff) ? new HeedlessCongestion() : base.Congestion();

        internal override SpareRate Spare() => fault.HasFlag(SessionFault.NeverBacksOff) ? new HeedlessSpareRate() : base.Spare();

        internal override LinkReceipts Hearing(SimTime now) =>
            fault.HasFlag(SessionFault.CountsTripsAgain) ? new RepeatingHearing(now) : base.Hearing(now);
    }

    private sealed class DroppingWindow(uint acknowledged) : SendWindow(acknowledged)
    {
        internal override uint After(uint added, uint first, uint last) => added == first && added < last ? added + 1 : added;
    }

    private sealed class HeedlessCongestion : CongestionControl
    {
        internal override bool IsCutFor(SimTime sent, bool hasQueue) => false;

        internal override void OnSilence(SimTime now)
        {
        }
    }

    private sealed class HeedlessSpareRate : SpareRate
    {
        internal override void Cut()
        {
        }

        internal override bool HasQueue(RoundTrips trips) => false;
    }

    private sealed class RepeatingHearing(SimTime now) : LinkReceipts(now)
    {
        internal override bool IsNewTrip(uint answered, uint counted) => true;
    }
}
