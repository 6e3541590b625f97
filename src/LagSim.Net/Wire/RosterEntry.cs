using System;
using System.Text;
using LagSim.Net.Protection;
using LagSim.Time;

namespace LagSim.Net.Wire;

/// <summary>What a <see cref="RosterDatagram"/> says of one number: who has it, or that nobody does.</summary>
/// <remarks>Immutable. <c>default</c> says that nobody has number 0.</remarks>
internal readonly struct RosterEntry
{
    /// <summary>The longest name, in bytes of UTF-8.</summary>
    public const int MaxNameBytes = PlayerName.MaxBytes;

    /// <summary>The role of a number that nobody has.</summary>
    public const byte NoRole = 0;

    /// <summary>The highest role.</summary>
    public const byte MaxRole = 3;

    /// <summary>The length of an entry of a number that nobody has.</summary>
    public const int GoneBytes = 2;

    /// <summary>The length of an entry without its name.</summary>
    public const int EmptyBytes = GoneBytes + sizeof(uint) + sizeof(long) + 1;

    private readonly string? name;

    /// <summary>Creates an entry from its fields.</summary>
    public RosterEntry(byte number, byte role = NoRole, uint visit = 0, SimTime silentSince = default, string? name = null)
    {
        Number = number;
        Role = role;
        Visit = visit;
        SilentSince = role == NoRole ? SimTime.MinValue : silentSince;
        this.name = name;
    }

    /// <summary>The number.</summary>
    public byte Number { get; }

    /// <summary>1 a player, 2 a spectator, 3 a bot; <see cref="NoRole"/> if nobody has the number.</summary>
    public byte Role { get; }

    /// <summary>Distinguishes those who have the number one after the other.</summary>
    public uint Visit { get; }

    /// <summary>The shared time at which it was last heard; <see cref="SimTime.MinValue"/> while it is heard.</summary>
    public SimTime SilentSince { get; }

    /// <summary>Its name; may be empty.</summary>
    public string Name => name ?? "";

    /// <summary>Its encoded length.</summary>
    public int EncodedLength => Role == NoRole ? GoneBytes : EmptyBytes + Encoding.UTF8.GetByteCount(Name);

    /// <summary>Whether all fields are the same.</summary>
    public bool IsSame(in RosterEntry other) => Number == other.Number && Role == other.Role && Visit == other.Visit
        && (Role == NoRole || SilentSince == other.SilentSince) && string.Equals(Name, other.Name, StringComparison.Ordinal);

    /// <summary>Reads a name; the reader refuses what <see cref="PlayerName"/> does.</summary>
    internal static string ReadName(ref WireReader reader)
    {
        string name = WireText.Read(ref reader);
        reader.Require(PlayerName.WhyNone(name) is null);
        return name;
    }

    /// <summary>Writes the entry.</summary>
    internal void Write(ref WireWriter writer)
    {
        writer.WriteByte(Number);
        writer.WriteByte(Role);
        if (Role != NoRole)
        {
            writer.WriteUInt32(Visit);
            writer.WriteOptionalTime(SilentSince);
            WireText.Write(ref writer, Name);
        }
    }

    /// <summary>Reads an entry.</summary>
    internal static RosterEntry Read(ref WireReader reader)
    {
        byte number = reader.ReadByte();
        byte role = reader.ReadByte();
        reader.Require(role <= MaxRole);
        return role == NoRole
            ? new RosterEntry(number)
            : new RosterEntry(number, role, reader.ReadUInt32(), reader.ReadOptionalTime(), ReadName(ref reader));
    }
}
