using System;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Peers;

/// <summary>
/// What one peer showed: for each instant of the grid the state of every body, read when that peer's shared clock had just reached it.
/// </summary>
/// <remarks>Written by one thread, the one that plays the game's frame; read once that has ended.</remarks>
public sealed class PeerSamples
{
    private readonly SampleGrid grid;
    private readonly BodyId[] bodies;
    private readonly SimDuration displayDelay;
    private readonly BodyState[] states;
    private readonly bool[] shown;
    private long lastNumber;

    /// <summary>No sample taken yet.</summary>
    /// <param name="grid">The instants.</param>
    /// <param name="bodies">Who is looked at.</param>
    /// <param name="displayDelay">How far behind its shared clock the peer shows the world; default not at all.</param>
    public PeerSamples(SampleGrid grid, BodyId[] bodies, SimDuration displayDelay = default)
    {
        ArgumentNullException.ThrowIfNull(bodies);
        this.displayDelay = displayDelay;
        this.grid = grid;
        this.bodies = bodies;
        states = new BodyState[grid.Count * bodies.Length];
        shown = new bool[grid.Count];
    }

    /// <summary>The number of the next instant to be sampled.</summary>
    public int Next { get; private set; }

    /// <summary>Whether all instants were dealt with.</summary>
    public bool IsComplete => Next == grid.Count;

    /// <summary>The next instant; only while not complete.</summary>
    public SimTime NextTime => grid.At(Next);

    /// <summary>
    /// The instant of the world that the peer shows when its shared clock reads that; never one before the scene began. See
    /// <see cref="Net.Sessions.Session.DisplayTime"/>.
    /// </summary>
    public SimTime ShownAt(SimTime shared) => SimTime.Max(shared - displayDelay, SimTime.Min(shared, grid.Start));

    /// <summary>Whether the peer's render snapshot covered the n-th instant at the time; if not it stalled.</summary>
    public bool IsShown(int n) => shown[n];

    /// <summary>The state of a body at the n-th instant, by its place in the list of bodies.</summary>
    public BodyState State(int n, int body) => states[(n * bodies.Length) + body];

    /// <summary>Samples every instant that the clock has reached.</summary>
    /// <param name="snapshot">What the peer shows now; null: nothing.</param>
    /// <param name="now">What its shared clock reads now.</param>
    /// <param name="timeout"> An instant further in the past than this, which was not sampled when it was due, counts as stalled, unless
    /// the render snapshot is still the one of the last look: then it showed the instant as it does now.
    /// </param>
    public void Take(RenderSnapshot? snapshot, SimTime now, SimDuration timeout)
    {
        bool unchanged = snapshot is not null && snapshot.Number == lastNumber;
        lastNumber = snapshot?.Number ?? 0;
        while (!IsComplete && NextTime <= now)
        {
            if ((unchanged || now - NextTime <= timeout) && snapshot is not null && snapshot.Covers(ShownAt(NextTime)))
            {
                Read(snapshot, ShownAt(NextTime), Next);
            }

            Next++;
        }
    }

    /// <summary>
    /// Samples the n-th instant as the render snapshot shows another one; what is seen at one true instant differs by the clocks' error.
    /// </summary>
    public void TakeAt(int n, RenderSnapshot? snapshot, SimTime now)
    {
        if (snapshot is not null && snapshot.Covers(ShownAt(now)))
        {
            Read(snapshot, ShownAt(now), n);
        }

        Next = Math.Max(Next, n + 1);
    }

    /// <summary>Samples all that the simulation still has of each instant, whatever was shown then, and whenever it was shown.</summary>
    public void TakeSettled(Simulation simulation)
    {
        ArgumentNullException.ThrowIfNull(simulation);
        for (; Next < grid.Count; Next++)
        {
            SimTime time = NextTime;
            if (time < simulation.HistoryEdge || time > simulation.Horizon)
            {
                continue;
            }

            for (int body = 0; body < bodies.Length; body++)
            {
                simulation.TryRead(bodies[body], time, out states[(Next * bodies.Length) + body]);
            }

            shown[Next] = true;
        }
    }

    private void Read(RenderSnapshot snapshot, SimTime time, int n)
    {
        for (int body = 0; body < bodies.Length; body++)
        {
            snapshot.TryRead(bodies[body], time, out states[(n * bodies.Length) + body]);
        }

        shown[n] = true;
    }
}
