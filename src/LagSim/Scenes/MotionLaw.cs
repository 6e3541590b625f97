namespace LagSim.Scenes;

/// <summary>How a body moves between events. The numbers stand in wire and hashes: never renumber.</summary>
public enum MotionLaw : byte
{
    /// <summary>The body is not there: before its spawn or after its removal. Never a scene's choice.</summary>
    Absent = 0,

    /// <summary>Free flight under uniform gravity, in closed form. One segment from contact to contact.</summary>
    Ballistic = 1,

    /// <summary>Free flight integrated by the classical fourth-order Runge-Kutta method with a fixed step, one segment a step.</summary>
    RungeKutta4 = 2,

    /// <summary>Frictionless motion along one or two static planes, in closed form. Entered from flight, never a scene's choice.</summary>
    Sliding = 3,

    /// <summary>At rest on static planes, or wedged without play for 50 ms at a time; costs nothing until something touches it. Entered from flight or sliding, never a scene's choice.</summary>
    Resting = 4,

    /// <summary>In a hand, whose path it has, a cubic or parabola from knot to knot; nothing it meets changes that. Entered by a grab, never a scene's choice.</summary>
    Held = 5,
}
