using LagSim.Time;

namespace LagSim.Net.Clocks;

/// <summary>
/// What one exchange says of another clock's offset, whatever the two ways took: at most this when it left, at least that when it came
/// back.
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
        LeastDrift = double.NegativeInfinity;
        MostDrift = double.PositiveInfinity;
    }

    /// <summary>The own time it came back.</summary>
    internal readonly SimTime Back => back;

    /// <summary>The least offset when it came back.</summary>
    internal readonly SimDuration Least => least;

    /// <summary>The least drift that this exchange and those before it leave possible, as a fraction.</summary>
    internal double LeastDrift { get; private set; }

    /// <summary>The most drift that this exchange and those before it leave possible, as a fraction.</summary>
    internal double MostDrift { get; private set; }

    /// <summary>How long from the request to the answer, in seconds of one's own clock, the wait at the other peer included.</summary>
    internal readonly double Length => (back - left).ToSeconds();

    /// <summary>
    /// How much room it leaves the offset, in seconds, if the clocks drift apart like this: at the true drift, the round trip.
    /// </summary>
    internal readonly double Width(double drift) => (most - least).ToSeconds() + (drift * Length);

    /// <summary>The most that the offset can be at an own time, in seconds above a reference, after this drift.</summary>
    internal readonly double MostAt(SimTime at, SimDuration reference, double drift) => (most - reference).ToSeconds() + (drift * (at - left).ToSeconds());

    /// <summary>The least that the offset can be at an own time, in seconds above a reference, after this drift.</summary>
    internal readonly double LeastAt(SimTime at, SimDuration reference, double drift) => (least - reference).ToSeconds() + (drift * (at - back).ToSeconds());

    /// <summary>How long ago the middle of it was, in seconds.</summary>
    internal readonly double Age(SimTime at) => ((at - left).ToSeconds() + (at - back).ToSeconds()) / 2;

    /// <summary>
    /// The middle of the two limits, and the middle of their times: both on the line, whatever the drift, if the two ways are alike.
    /// </summary>
    internal readonly (double Time, double Offset) Middle(SimTime at, SimDuration reference) =>
        (-Age(at), ((most - reference).ToSeconds() + (least - reference).ToSeconds()) / 2);

    /// <summary>Takes from an earlier exchange what the two together say of the drift.</summary>
    /// <param name="earlier">One that came back no later.</param>
    /// <param name="slack">How wrong the difference of two limits may be, in seconds.</param>
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

    /// <summary>Takes over a narrower range of drift.</summary>
    internal void Intersect(double leastDrift, double mostDrift)
    {
        LeastDrift = leastDrift > LeastDrift ? leastDrift : LeastDrift;
        MostDrift = mostDrift < MostDrift ? mostDrift : MostDrift;
    }
}
