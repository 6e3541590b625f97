using System.Globalization;

namespace LagSim.Net.Recordings;

/// <summary>Where a recording can no longer be read, and why. Everything before is valid.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class RecordingDamage
{
    internal RecordingDamage(long offset, string reason)
    {
        Offset = offset;
        Reason = reason;
    }

    /// <summary>The byte offset in the file at which the first invalid record begins, counted from 0.</summary>
    public long Offset { get; }

    /// <summary>The error found there, as a sentence.</summary>
    public string Reason { get; }

    /// <summary>Both, as a sentence.</summary>
    public override string ToString() => string.Format(CultureInfo.InvariantCulture, "Damaged at byte {0}: {1}", Offset, Reason);
}
