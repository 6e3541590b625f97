namespace LagSim.Net.Wire;

/// <summary>Why bytes were not accepted as a datagram. For counters and messages; never sent.</summary>
internal enum WireRefusal : byte
{
    /// <summary>It was accepted.</summary>
    None = 0,

    /// <summary>It ends before its last field.</summary>
    TooShort = 1,

    /// <summary>It is longer than <see cref="WireFormat.MaxPlainBytes"/>; a sealed one, than <see cref="WireFormat.MaxBytes"/>.</summary>
    TooLong = 2,

    /// <summary>It does not begin with <see cref="WireFormat.Magic"/>.</summary>
    NotLagSim = 3,

    /// <summary>It is of another version than <see cref="WireFormat.Version"/>.</summary>
    VersionDiffers = 4,

    /// <summary>Its type is none of <see cref="DatagramType"/>.</summary>
    UnknownType = 5,

    /// <summary>It is of a known type, but not the requested one.</summary>
    OtherType = 6,

    /// <summary>A field is out of range.</summary>
    BadValue = 7,

    /// <summary>Something follows its last field.</summary>
    TrailingBytes = 8,
}
