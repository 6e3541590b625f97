using System;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Peers;

/// <summary>
/// The samples of one peer: the state of every body at each instant of the grid, read when that peer's shared clock had just reached it.
/// </summary>
/// <remarks>Written by one thread, that of the game's frames; read once that has ended.</remarks>
public sealed class PeerSamples
{
    private readonly SampleGrid grid;
    private readonly BodyId[] bodies;
    private readonly SimDuration displayDelay;
    private readonly BodyState[] states;
    private readonly bool[] shown;
    private long lastNumber;

    /// <summary>Creates an empty set of samples.</summary>
    /// <param name="grid">The instants.</param>
    /// <param name="bodies">The bodies to sample.</param>
    /// <param name="displayDelay">How far behind its shared clock the peer shows the world; default zero.</param>
    public PeerSamples(SampleGrid grid, BodyId[] bodies, SimDuration displayDelay = default)
    {
        ArgumentNullException.ThrowIfNull(bodies);
        this.displayDelay = displayDelay;
        this.grid = grid;
        this.bodies = bodies;
        states = new BodyState[grid.Count * bodies.Length];
        shown = new bool[grid.Count];
    }

    /// <summary>The index of the next instant to sample.</summary>
    public int Next { get; private set; }

    /// <summary>Whether all instants were sampled or missed.</summary>
    public bool IsComplete => Next == grid.Count;

    /// <summary>The next instant. Call it only while not complete.</summary>
    public SimTime NextTime => grid.At(Next);

    /// <summary>
    /// Returns the instant of the world that the peer shows at a reading of its shared clock; never one before the start of the scene. See
    /// <see cref="Net.Sessions.Session.DisplayTime"/>.
    /// </summary>
    public SimTime ShownAt(SimTime shared) => SimTime.Max(shared - displayDelay, SimTime.Min(shared, grid.Start));

    /// <summary>Whether the peer's render snapshot covered the n-th instant when it was due; if not, the peer stalled.</summary>
    public bool IsShown(int n) => shown[n];

    /// <summary>The state of a body at the n-th instant, by its place in the list of bodies.</summary>
    public BodyState State(int n, int body) => states[(n * bodies.Length) + body];

    /// <summary>Samples every instant that the clock has reached.</summary>
    /// <param name="snapshot">The current render snapshot of the peer; null for none.</param>
    /// <param name="now">The current reading of its shared clock.</param>
    /// <param name="timeout">An instant further in the past than this, which was not sampled when it was due, counts as stalled, unless the
    /// render snapshot is still the one of the last sample: then it showed that instant as it does now.</param>
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
    /// Samples the n-th instant from a render snapshot of another instant. Samples at one true instant differ by the clocks' error.
    /// </summary>
    public void TakeAt(int n, RenderSnapshot? snapshot, SimTime now)
    {
        if (snapshot is not null && snapshot.Covers(ShownAt(now)))
        {
            Read(snapshot, ShownAt(now), n);
        }

        Next = Math.Max(Next, n + 1);
    }

    /// <summary>Samples every instant that the simulation still has, whatever was shown then.</summary>
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
