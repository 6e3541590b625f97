namespace LagSim.Scenes;

/// <summary>How a body moves between events. The numbers are part of wire and hashes: never renumber.</summary>
public enum MotionLaw : byte
{
    /// <summary>The body is not there: before its spawn or after its removal. Never a scene's choice.</summary>
    Absent = 0,

    /// <summary>Free flight under uniform gravity, in closed form. One segment from contact to contact.</summary>
    Ballistic = 1,

    /// <summary>Free flight integrated by the classical fourth-order Runge-Kutta method with a fixed step, one segment a step.</summary>
    RungeKutta4 = 2,

    /// <summary>
    /// Motion along one or two static planes, in closed form: without friction, or slipping on one against it. Entered from flight, never a
    /// scene's choice.
    /// </summary>
    Sliding = 3,

    /// <summary>
    /// At rest on static planes, or in an island of bodies at rest: the centre stays where it is, and that costs nothing until something
    /// touches the body. Never a scene's choice. It may turn all the while, evenly: about the plane's normal, which no friction resists
    /// here, and without friction about anything (<see cref="BodyState.Spin"/>).
    /// </summary>
    Resting = 4,

    /// <summary>
    /// Held by a hand, with the hand's path: a cubic or parabola from keyframe to keyframe, which no contact changes. Entered by a grab,
    /// never a scene's choice.
    /// </summary>
    Held = 5,

    /// <summary>
    /// Free flight in closed form under forces that have one: gravity with linear drag, springs and magnetic fields in any mixture, or one
    /// centre that pulls as gravity does. One segment for as long as a polynomial of degree five follows it within the body's tolerance.
    /// </summary>
    ClosedForm = 6,

    /// <summary>
    /// Free flight integrated by the Runge-Kutta method of orders 5 and 4 by Dormand and Prince, with steps as long as the body's tolerance
    /// lets them be, or fixed ones.
    /// </summary>
    DormandPrince54 = 7,

    /// <summary>
    /// The cheapest of the laws above that is exact for the forces that act on the body: <see cref="Ballistic"/> under gravity alone,
    /// <see cref="ClosedForm"/> where there is one, else <see cref="DormandPrince54"/>. A scene may ask for it; no body ever moves by it.
    /// </summary>
    Automatic = 8,

    /// <summary>
    /// Rolling on one static plane without slipping, in closed form. Entered when friction has stopped the slip, ends at rest where there
    /// is rolling resistance; never a scene's choice.
    /// </summary>
    Rolling = 9,

    /// <summary>
    /// In persistent contact with other bodies, with a static sphere, or with planes under forces: an island of such bodies moves by steps
    /// of at most 1/64 s, a cubic each, that are taken for all of it together. Entered from an impact, ends in flight, on planes, or at
    /// rest; never a scene's choice.
    /// </summary>
    Constrained = 10,
}
