namespace LagSim.Events;

/// <summary>The partner or surface of a body's pending impact, and the segment it was found with.</summary>
internal struct PendingContact
{
    /// <summary>The partner of what is no contact with another body.</summary>
    internal const int NoPartner = -1;

    /// <summary>The other body's slot, or <see cref="NoPartner"/>.</summary>
    internal int Partner;

    /// <summary>The static surface, if there is no partner.</summary>
    internal int Surface;

    /// <summary>The serial of the partner's segment that the impact was found with.</summary>
    internal long PartnerSerial;

    /// <summary>How far the unrounded root lies from its tick, in seconds.</summary>
    internal double Residual;

    /// <summary>Whether the body may have another event at the tick of its pending one, which no body waits for.</summary>
    internal bool IsTied;
}
