using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;
using MathNet.Numerics;
using MathNet.Numerics.LinearAlgebra;
using MathNet.Numerics.OdeSolvers;

namespace LagSim.Harness.Experiments.Accuracy.Engines;

/// <summary>MathNet.Numerics' fourth-order Runge-Kutta, used as an application would use it.</summary>
/// <remarks>
/// It is an integrator without contacts. Here each body is a system of its own, with one call a step. A step that ends beyond a surface is
/// repeated with half the time, 60 times by bisection, until the touch is found to a rounding. There the velocity is reflected, and the
/// rest of the step is done. Scenes in which bodies meet each other are left out.
/// </remarks>
internal sealed class MathNetMethod : SteppedEngine
{
    private const int Halvings = 60;

    static MathNetMethod() => Control.UseManaged(); // the search for native providers at first use takes long

    public override string Name => "MathNet RungeKutta4";

    public override string Engine => "mathnet";

    public override string? Excludes(WorkScene scene) => scene.HasPairs ? "it is an integrator; contacts of bodies with each other are not in it" : null;

    protected override IReadOnlyList<double> Rates(WorkScene scene) => scene.IntegratorRates;

    protected override Run Begin(WorkScene scene, double step) => new MathNetRun(scene, step);

    private sealed class MathNetRun : Run
    {
        private readonly Vector<double>[] states;
        private readonly Func<double, Vector<double>, Vector<double>> slope;

        internal MathNetRun(WorkScene work, double step)
            : base(work, step)
        {
            states = [.. Scene.Bodies.Select(body => Vector<double>.Build.DenseOfArray([.. Numbers(body.Position), .. Numbers(body.Velocity)]))];
            Vector3D gravity = Scene.Gravity;
            slope = (t, y) =>
            {
                Vector3D a = gravity + work.Push(1, t, new Vector3D(y[0], y[1], y[2]), new Vector3D(y[3], y[4], y[5]));
                return Vector<double>.Build.DenseOfArray([y[3], y[4], y[5], a.X, a.Y, a.Z]);
            };
        }

        public override Vector3D Position(int body) => Place(states[body]);

        public override Vector3D Velocity(int body) => Speed(states[body]);

        public override void Dispose()
        {
        }

        protected override void Step()
        {
            for (int n = 0; n < states.Length; n++)
            {
                states[n] = Step(states[n], Scene.Bodies[n].Spec);
            }
        }

        private Vector<double> Step(Vector<double> state, BodySpec spec)
        {
            double t = Seconds, left = StepSeconds;
            while (true)
            {
                Vector<double> end = Integrate(state, t, left);
                if (Crossed(end, spec) is not StaticPlane plane)
                {
                    return end;
                }

                double low = 0, high = left;
                for (int n = 0; n < Halvings; n++)
                {
                    double middle = 0.5 * (low + high);
                    (low, high) = plane.Gap(Place(Integrate(state, t, middle)), spec.Radius) > 0 ? (middle, high) : (low, middle);
                }

                state = Integrate(state, t, low);
                Vector3D v = Speed(state);
                v -= plane.Normal * ((1 + Math.Min(spec.Restitution, plane.Restitution)) * Vector3D.Dot(plane.Normal, v));
                state = Vector<double>.Build.DenseOfArray([state[0], state[1], state[2], v.X, v.Y, v.Z]);
                t += low;
                left -= low;
            }
        }

        private Vector<double> Integrate(Vector<double> state, double t, double h) => RungeKutta.FourthOrder(state, t, t + h, 2, slope)[1];

        private StaticPlane? Crossed(Vector<double> state, BodySpec spec)
        {
            foreach (StaticPlane plane in Scene.Planes)
            {
                if (plane.Gap(Place(state), spec.Radius) < 0 && Vector3D.Dot(plane.Normal, Speed(state)) < 0)
                {
                    return plane;
                }
            }

            return null;
        }

        private static double[] Numbers(in Vector3D v) => [v.X, v.Y, v.Z];

        private static Vector3D Place(Vector<double> state) => new(state[0], state[1], state[2]);

        private static Vector3D Speed(Vector<double> state) => new(state[3], state[4], state[5]);
    }
}
