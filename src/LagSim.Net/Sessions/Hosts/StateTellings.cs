using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Up to which committed state a client is known to have the host's hashes.</summary>
internal sealed class StateTellings
{
    private readonly (uint Number, SimTime UpTo)[] tellings = new (uint, SimTime)[32]; // by the number of the update

    /// <summary>The newest committed state whose hash it is known to have, or that lies before its own first one.</summary>
    internal SimTime Told { get; private set; } = SimTime.MinValue;

    /// <summary>Records up to which committed state an update reports hashes.</summary>
    internal void Note(uint number, SimTime upTo) => tellings[number % (uint)tellings.Length] = (number, upTo);

    /// <summary>Records that an update arrived.</summary>
    internal void NoteEcho(uint number)
    {
        (uint Number, SimTime UpTo) telling = tellings[number % (uint)tellings.Length];
        Told = number > 0 && telling.Number == number ? SimTime.Max(Told, telling.UpTo) : Told;
    }
}
