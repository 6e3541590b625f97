using LagSim.Time;

namespace LagSim.Net.Clocks;

/// <summary>
/// The limits that one exchange sets to another clock's offset, whatever the two directions took: an upper one when it left, a lower one
/// when it came back.
/// </summary>
internal struct ClockExchange
{
    private readonly SimTime left;
    private readonly SimTime back;
    private readonly SimDuration most;
    private readonly SimDuration least;

    internal ClockExchange(SimTime ownSend, SimTime otherReceive, SimTime otherSend, SimTime ownReceive)
    {
        left = ownSend;
        back = ownReceive;
        most = otherReceive - ownSend; // when it left, the other clock had not yet read what it read on arrival
        least = otherSend - ownReceive; // when it came back, the other clock had already read what it read on leaving
        MinDriftSeen = double.NegativeInfinity;
        MaxDriftSeen = double.PositiveInfinity;
    }

    /// <summary>The local time at which it came back.</summary>
    internal readonly SimTime Back => back;

    /// <summary>The least offset when it came back.</summary>
    internal readonly SimDuration Least => least;

    /// <summary>The least drift that this exchange and those before it allow, as a fraction.</summary>
    internal double MinDriftSeen { get; private set; }

    /// <summary>The most drift that this exchange and those before it allow, as a fraction.</summary>
    internal double MaxDriftSeen { get; private set; }

    /// <summary>The time from the request to the answer, in seconds of the local clock, including the wait at the other peer.</summary>
    internal readonly double Length => (back - left).ToSeconds();

    /// <summary>The width of the range that it leaves the offset, in seconds, for that drift: at the true drift, the round trip.</summary>
    internal readonly double Width(double drift) => (most - least).ToSeconds() + (drift * Length);

    /// <summary>The greatest possible offset at a local time, in seconds above a reference, for that drift.</summary>
    internal readonly double UpperBoundAt(SimTime at, SimDuration reference, double drift) =>
        (most - reference).ToSeconds() + (drift * (at - left).ToSeconds());

    /// <summary>The least possible offset at a local time, in seconds above a reference, for that drift.</summary>
    internal readonly double LowerBoundAt(SimTime at, SimDuration reference, double drift) =>
        (least - reference).ToSeconds() + (drift * (at - back).ToSeconds());

    /// <summary>How long ago its midpoint was, in seconds.</summary>
    internal readonly double Age(SimTime at) => ((at - left).ToSeconds() + (at - back).ToSeconds()) / 2;

    /// <summary>
    /// The midpoint of the two limits and of their times, which lies on the line, whatever the drift, if the two directions are equal.
    /// </summary>
    internal readonly (double Time, double Offset) Middle(SimTime at, SimDuration reference) =>
        (-Age(at), ((most - reference).ToSeconds() + (least - reference).ToSeconds()) / 2);

    /// <summary>Narrows the drift by what this and an earlier exchange imply together.</summary>
    /// <param name="earlier">An exchange that came back no later.</param>
    /// <param name="slack">The possible error of the difference of two limits, in seconds.</param>
    internal void LimitDrift(in ClockExchange earlier, double slack)
    {
        double between = (left - earlier.back).ToSeconds();
        if (between > 0)
        {
            Intersect(double.NegativeInfinity, ((most - earlier.least).ToSeconds() + slack) / between);
        }

        double around = (back - earlier.left).ToSeconds();
        if (around > 0)
        {
            Intersect(((least - earlier.most).ToSeconds() - slack) / around, double.PositiveInfinity);
        }
    }

    /// <summary>Intersects with a narrower range of drift.</summary>
    internal void Intersect(double minDrift, double maxDrift)
    {
        MinDriftSeen = minDrift > MinDriftSeen ? minDrift : MinDriftSeen;
        MaxDriftSeen = maxDrift < MaxDriftSeen ? maxDrift : MaxDriftSeen;
    }
}
