using System;
using LagSim.Scenes;

namespace LagSim.Harness.SceneFiles;

/// <summary>
/// Pool: fifteen balls in a rack that touch one another, a cue ball on its way to them, a table, four cushions, no pockets, no friction.
/// </summary>
/// <remarks>
/// A table of nine feet, 100 by 50 inches between the cushions; balls of 2 1/4 inches and 6 ounces. The cue ball comes a little off the
/// middle, as in a real break: a mirror-symmetrical one would stay so.
/// </remarks>
internal static class BilliardsScene
{
    internal const string Name = "billiards";
    internal const double Radius = 0.028575;
    internal const double Mass = 0.17;
    internal const double Length = 2.54;
    internal const double Width = 1.27;
    internal const double BreakSpeed = 8;

    private const int Rows = 5;
    private const double OffTheMiddle = 0.01;

    internal static Scene Build(double ballRestitution, double cushionRestitution, double breakSpeed)
    {
        BodySpec ball = new(Radius, Mass, ballRestitution);
        SceneBuilder builder = new SceneBuilder(Name)
            .AddPlane("table", Vector3D.Up, Vector3D.Zero)
            .AddPlane("head", new Vector3D(1, 0, 0), -Length / 2, cushionRestitution)
            .AddPlane("foot", new Vector3D(-1, 0, 0), -Length / 2, cushionRestitution)
            .AddPlane("left", new Vector3D(0, 0, 1), -Width / 2, cushionRestitution)
            .AddPlane("right", new Vector3D(0, 0, -1), -Width / 2, cushionRestitution)
            .AddBody("cue", ball, new Vector3D(-Length / 4, Radius, OffTheMiddle), new Vector3D(breakSpeed, 0, 0));
        int number = 1;
        for (int row = 0; row < Rows; row++)
        {
            double x = (Length / 4) + (row * Radius * Math.Sqrt(3));
            for (int place = 0; place <= row; place++)
            {
                builder.AddBody($"ball {number++}", ball, new Vector3D(x, Radius, ((2 * place) - row) * Radius));
            }
        }

        return builder.Build();
    }
}
