using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Trajectories;

/// <summary>Opens flights: of a body that nothing holds, by the law that its scene gives it.</summary>
internal sealed class FlightFactory(
    Scene scene, in Forces forces, BodyTable bodies, TimelineStore timelines, StateLimits limits, BodyLoss loss, ForceFailures failures)
{
    private readonly Forces forces = forces;

    /// <summary>Opens a flight of a body from a state on, unless no law follows it: then the body is lost.</summary>
    internal void Open(int slot, in EventKey key, in Vector3D position, in Vector3D velocity, in Vector3D spin = default)
    {
        Vector3D x = scene.Box.Wrap(position.WithoutNegativeZero());
        Vector3D v = velocity.WithoutNegativeZero();
        ref readonly BodySpec spec = ref bodies.Spec(slot);
        if (!loss.TryAllow(slot, key, x, v))
        {
            return;
        }

        if (spec.Flight == MotionLaw.Ballistic)
        {
            SimTime end = scene.Box.Exists ? limits.EndOfFlight(key.Time, v) : limits.EndOfRange(key.Time, v, scene.Gravity);
            timelines.Append(slot, bodies.Id(slot), key, new MotionSegment(MotionLaw.Ballistic, key.Time, end, x, v, scene.Gravity), default, spin: new Spin(spin));
        }
        else
        {
            MotionSegment piece = PieceOfFlight(slot, key.Time, x, v, spin, out DenseOutput dense, out LossReason why);
            if (why != LossReason.None)
            {
                loss.Lose(slot, key, x, v, why, spin);
            }
            else
            {
                timelines.Append(slot, bodies.Id(slot), key, piece, dense, spin: new Spin(spin));
            }
        }
    }

    /// <summary>
    /// The first segment of a flight that is not a parabola: a step of an integrator, or as much of a closed form as a polynomial follows.
    /// It is not to be used where there is a reason why it does not follow the forces.
    /// </summary>
    private MotionSegment PieceOfFlight(
        int slot, SimTime from, in Vector3D x, in Vector3D v, in Vector3D spin, out DenseOutput dense, out LossReason why)
    {
        ref readonly BodySpec spec = ref bodies.Spec(slot);
        double tooStiff = 0;
        double tooLarge = 0;
        Forces on = forces.On(bodies.Id(slot));
        MotionSegment piece = spec.Flight switch
        {
            MotionLaw.RungeKutta4 => RungeKutta4.Step(on, spec, from, x, v, spin, out dense, out tooStiff),
            MotionLaw.ClosedForm when FlightLaws.AreLinear(spec, scene.ForceArray) => new LinearFlight(scene, spec, spin).Piece(on, from, x, v, out dense),
            MotionLaw.ClosedForm => new KeplerFlight(scene, spec).Piece(from, x, v, out dense, out tooLarge),
            _ => DormandPrince54.Step(on, spec, from, x, v, spin, StepToTry(slot), out dense, out tooLarge, out tooStiff),
        };
        bool isFinite = piece.Acceleration.IsFinite && dense.IsFinite;
        why = tooStiff > 0 || (isFinite && tooLarge > 0) ? LossReason.TooStiff : isFinite ? LossReason.None : LossReason.NotFinite;
        if (why != LossReason.None && forces.HasSupplied(spec))
        {
            throw failures.OfSupplied(slot, from, x, v, isFinite);
        }

        return piece;
    }

    /// <summary>The step that the one before proposes, if there was one; else none.</summary>
    private SimDuration StepToTry(int slot)
    {
        int last = timelines.Last(slot);
        return last == TimelineStore.None || timelines.Segment(last).Law != MotionLaw.DormandPrince54 ? SimDuration.Zero : timelines.Dense(last).NextStep;
    }

    /// <summary>A body with the law of flight that it asks for, or that is the cheapest for it.</summary>
    internal BodySpec Chosen(in BodySpec spec)
    {
        MotionLaw law = FlightLaws.Chosen(spec, scene.Gravity, scene.ForceArray);
        return law == spec.Flight ? spec : spec.With(law);
    }
}
