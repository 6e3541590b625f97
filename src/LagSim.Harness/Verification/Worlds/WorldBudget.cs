using LagSim.Time;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>The events that a world may take, so that one that needs too many ends its check and not the time of all others.</summary>
internal sealed class WorldBudget
{
    private readonly long events;
    private long left;

    internal WorldBudget(long events)
    {
        this.events = events;
        left = events;
    }

    /// <summary>The number of events taken.</summary>
    internal long Taken => events - left;

    /// <summary>Advances a world. Throws where it would need more.</summary>
    /// <exception cref="WorldBudgetException">It needs more.</exception>
    internal void Advance(Simulation world, SimTime to)
    {
        if (!world.TryAdvanceTo(SimTime.Max(to, world.SimulatedTo), ref left))
        {
            throw new WorldBudgetException();
        }
    }

    /// <summary>Advances a world by no more than a number of events; it need not get there.</summary>
    /// <exception cref="WorldBudgetException">No events are left.</exception>
    internal void AdvancePartly(Simulation world, SimTime to, long piece)
    {
        long rest = piece;
        world.TryAdvanceTo(SimTime.Max(to, world.SimulatedTo), ref rest);
        left -= piece - rest;
        if (left <= 0)
        {
            throw new WorldBudgetException();
        }
    }
}
