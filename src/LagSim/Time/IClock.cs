namespace LagSim.Time;

/// <summary>A clock that only goes forward, so that everything in real time can also run in virtual time.</summary>
/// <remarks>The origin means nothing: only differences do. Implementations may be read from any thread.</remarks>
public interface IClock
{
    /// <summary>The clock's reading now.</summary>
    SimTime Now { get; }
}
