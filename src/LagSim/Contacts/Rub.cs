using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>What a lasting contact does across its normal: how much it may, and how much it does.</summary>
internal struct Rub
{
    /// <summary>The coefficient of friction.</summary>
    internal double Friction;

    /// <summary>The lever of rolling resistance in metres: its coefficient times the radius of what rolls.</summary>
    internal double Lever;

    /// <summary>How large the impulse of friction may be, in N s: what the normal impulse allows, followed gently.</summary>
    internal double Allowed;

    /// <summary>The impulse of friction on the first of the two, in N s.</summary>
    internal Vector3D Push;

    /// <summary>
    /// The angular impulse of rolling resistance on the first, in N m s: across the normal against rolling, along it against turning on the spot.
    /// </summary>
    internal Vector3D Turn;
}
