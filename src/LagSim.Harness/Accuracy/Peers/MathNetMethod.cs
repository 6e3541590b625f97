using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;
using MathNet.Numerics;
using MathNet.Numerics.LinearAlgebra;
using MathNet.Numerics.OdeSolvers;

namespace LagSim.Harness.Accuracy.Peers;

/// <summary>MathNet.Numerics' fourth-order Runge-Kutta, as who needs an integrator would use it.</summary>
/// <remarks>
/// It integrates; contacts are not in it. Here each body is a system of its own, one call a step. A step that ends beyond a surface is called again with half
/// the time, 60 times by bisection, until the touch is found to a rounding; there the velocity is reflected, and what is left of the step is done. So bodies
/// that meet each other are left out.
/// </remarks>
internal sealed class MathNetMethod : IWorkMethod
{
    private const int Halvings = 60;

    static MathNetMethod() => Control.UseManaged(); // native providers are looked for at first use, which takes long

    public string Name => "MathNet RungeKutta4";

    public string Engine => "mathnet";

    public string? Missing => null;

    public string? Excludes(WorkScene scene) => scene.HasPairs ? "it is an integrator; contacts of bodies with each other are not in it" : null;

    public IReadOnlyList<WorkSetting> Settings(WorkScene scene) => [.. scene.IntegratorRates.Select(WorkSetting.Rate)];

    public IWorkRun Start(WorkScene scene, WorkSetting setting) => new Run(scene, setting.StepSeconds);

    private sealed class Run : IWorkRun
    {
        private readonly Scene scene;
        private readonly double step;
        private readonly Vector<double>[] states;
        private readonly Func<double, Vector<double>, Vector<double>> slope;

        internal Run(WorkScene work, double step)
        {
            scene = work.Scene;
            this.step = step;
            states = [.. scene.Bodies.Select(body => Vector<double>.Build.DenseOfArray([.. Numbers(body.Position), .. Numbers(body.Velocity)]))];
            Vector3D gravity = scene.Gravity;
            slope = (t, y) =>
            {
                Vector3D a = gravity + work.Push(1, t, new Vector3D(y[0], y[1], y[2]), new Vector3D(y[3], y[4], y[5]));
                return Vector<double>.Build.DenseOfArray([y[3], y[4], y[5], a.X, a.Y, a.Z]);
            };
        }

        public double Seconds => Events * step;

        public long Events { get; private set; }

        public void AdvanceTo(double seconds)
        {
            for (long end = (long)Math.Round(seconds / step); Events < end; Events++)
            {
                for (int n = 0; n < states.Length; n++)
                {
                    states[n] = Step(states[n], scene.Bodies[n].Spec);
                }
            }
        }

        public Vector3D Position(int body) => Place(states[body]);

        public Vector3D Velocity(int body) => Speed(states[body]);

        public void Dispose()
        {
        }

        private Vector<double> Step(Vector<double> state, BodySpec spec)
        {
            double t = Seconds, left = step;
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
            foreach (StaticPlane plane in scene.Planes)
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
