#!/usr/bin/python3
import sys, os, json, csv
sys.path.insert(0, os.environ['DHCAL_SHARED'] + '/prototype')
import numpy as np, yaml
import dh
from dh import Case, State, forward, slots, loads, measure, exps
D = 180/np.pi
def J(t,d,a,al,ty='revolute'): return dict(theta_deg=t,d_m=d,a_m=a,alpha_deg=al,type=ty)
ROB = {
 'kr15': dict(conv='standard', rows=[J(0,.675,.3,90),J(0,0,.65,0),J(0,0,.155,90),J(0,.6,0,-90),J(0,0,0,90),J(0,.14,0,0)], lim=[(-150,150),(-60,90),(-100,80),(-150,150),(-90,90),(-150,150)], off=0),
 'ur5': dict(conv='standard', rows=[J(0,.0892,0,90),J(0,0,-.425,0),J(0,0,-.392,0),J(0,.109,0,90),J(0,.0947,0,-90),J(0,.0823,0,0)], lim=[(-170,170),(-150,-20),(-120,120),(-150,150),(-120,120),(-170,170)], off=0),
 'kr_mod': dict(conv='modified', rows=[J(0,.5,0,0),J(0,0,.26,-90),J(-90,0,.68,0),J(0,.67,.035,-90),J(0,0,0,90),J(0,.115,0,-90)], lim=[(-150,150),(-80,60),(-80,90),(-150,150),(-100,100),(-150,150)], off=0),
 'seven': dict(conv='standard', rows=[J(0,.36,0,-90),J(0,0,0,90),J(0,.42,0,90),J(0,0,0,-90),J(0,.4,0,-90),J(0,0,0,90),J(0,.126,0,0)], lim=[(-150,150),(-100,100),(-150,150),(-110,110),(-150,150),(-100,100),(-160,160)], off=0),
 'scara': dict(conv='standard', rows=[J(0,.4,.4,0),J(0,0,.35,180),J(0,0,0,0,'prismatic'),J(0,.05,0,0)], lim=[(-130,130),(-140,140),(20,180),(-170,170)], off=0),
}
KINDS = ['null','compliance','two_compliances','gear','mesh','backlash','coupling','gain','base_drift','joint_drift','tool_step','joint_step','wobble','balancer','bending','base_compliance','product','comp_gear','comp_drift','backlash_gear','three']
def make(seed, folder, force=None):
    r = np.random.default_rng(seed)
    ch = lambda l, p=None: l[r.choice(len(l), p=p)]
    kind = force or ch(KINDS, None)
    name = ch(['kr15','ur5','kr_mod','seven','scara'], [.3,.22,.22,.18,.08])
    R = ROB[name]; n = len(R['rows'])
    N = int(ch([100,150,200,300,400]));
    meas = ch(['position','pose','distance','adjacent'], [.6,.2,.08,.12])
    if name=='scara': meas='position'
    est = ch(['complete','tad'],[.5,.5])
    if meas=='distance': est='complete'; N=max(N,300)
    strength = float(np.exp(r.uniform(np.log(.5), np.log(30))))
    sig = float(ch([.01,.03,.05,.1]))*1e-3; given = r.random()<.7
    massmode = ch(['given','wrong','missing'],[.45,.25,.3])
    dec = int(ch([2,3,4,6],[.08,.22,.3,.4])); reps = int(ch([1,3,10],[.88,.06,.06]))
    if meas in('adjacent','distance'): reps=1
    outl = float(ch([0,.01,.03,.06],[.6,.15,.15,.1])); test = r.random()<.35
    tail = ch(['gauss','t3'],[.8,.2]); order = ch(['random','sorted'],[.8,.2])
    npose = N if reps==1 else max(60,N//3) if reps==3 else 40
    lim = np.array(R['lim'],float); rev = np.array([x['type']=='revolute' for x in R['rows']])
    q = r.uniform(lim[:,0],lim[:,1],(npose,n))
    if order=='sorted': q = q[np.argsort(q[:,0])]
    if reps>1: q = np.repeat(q, reps, 0)
    N = len(q); qr = np.round(q, dec)
    os.makedirs(folder, exist_ok=True)
    tool = dict(xyz_m=[.03,-.05,.12], rpy_deg=[0,0,0])
    base = dict(xyz_m=[0.,0.,0.], rpy_deg=[0,0,0])
    y = dict(schema=1, robot=dict(convention=R['conv'], joints=[dict(name=f'J{i+1}',**j) for i,j in enumerate(R['rows'])], base=base, tool=tool, gravity_m_s2=[0,0,-9.80665]),
             measurement=dict(kind='adjacent_position' if meas=='adjacent' else meas), recording='recording.csv', parameters=dict(estimate=['complete'] if est=='complete' else ['theta','alpha','a','d']), diagnosis=dict(run='always'))
    if meas=='adjacent': y['measurement']['noise']=str(ch(['independent','shared_pose']))
    if given: y['measurement']['sigma_mm']=sig*1e3
    srot = float(ch([.02,.05,.1]))*1e-3
    if given and meas=='pose': y['measurement']['sigma_rotation_mrad']=srot*1e3
    if meas=='distance': y['measurement']['anchors']={k:dict(xyz_m=v) for k,v in dict(A=[2.5,0,.2],B=[0,2.8,1.5],C=[-2,-2,2.2]).items()}
    m0 = np.array([30,25,15,8,4,2,1][:n],float); c0 = np.zeros((n,3))
    for k in range(n):
        if R['conv']=='standard': c0[k,0] = -R['rows'][k]['a_m']*.5
        elif k+1<n: c0[k,0] = R['rows'][k+1]['a_m']*.5
        c0[k] += r.normal(0,.02,3)
    if massmode!='missing':
        w = 1 if massmode=='given' else None
        mm = m0 if w else m0*(1+r.normal(0,.2,n)); cc = c0 if w else c0+r.normal(0,.025,(n,3))
        y['robot']['links']=[dict(mass_kg=float(a),com_m=[float(v) for v in b]) for a,b in zip(mm,cc)]
    pay = np.where(r.random(N)<.5, 0., 5.) if r.random()<.2 else np.zeros(N)
    t = np.arange(N)*20.
    head = [f'q{i+1}_deg' if rev[i] else f'q{i+1}_mm' for i in range(n)]
    cols = [[f'{v:.9f}' for v in q[:,i]] for i in range(n)]
    head += ['t_s']; cols.append([f'{v:.1f}' for v in t])
    if pay.any(): head.append('payload_kg'); cols.append([f'{v:.1f}' for v in pay])
    dirs = np.zeros((N,n),int)
    for k in range(1,N):
        s = np.sign(q[k]-q[k-1]).astype(int); dirs[k]=np.where(s==0,dirs[k-1],s)
    dirs[0]=r.choice([-1,1],n)
    anc = r.choice(['A','B','C'],N)
    def write(P, Rm, qq, fold, dec_q):
        h=list(head); cc=[[f'{v:.{dec_q}f}' for v in qq[:,i]] for i in range(n)]+cols[n:]
        if meas=='distance':
            h+=['anchor','distance_mm']; A=np.array([y['measurement']['anchors'][a]['xyz_m'] for a in anc]); cc+=[list(anc),[f'{v*1e3:.5f}' for v in P]]
        else:
            h+=['x_mm','y_mm','z_mm']; cc+=[[f'{v*1e3:.5f}' for v in P[:,i]] for i in range(3)]
            if meas=='pose':
                h+=['qw','qx','qy','qz']; cc+=[[f'{v:.9f}' for v in Rm[:,i]] for i in range(4)]
        if test and meas!='adjacent': h.append('set'); cc.append(['test' if k%5==4 and (reps==1) else 'train' for k in range(N)])
        with open(fold+'/recording.csv','w') as f: w=csv.writer(f); w.writerow(h); [w.writerow(x) for x in zip(*cc)]
    yy = json.loads(json.dumps(y)); 
    if meas!='distance':
        yy['measurement']=dict(kind='position')
    else: yy['measurement']['kind']='distance'
    yy['robot']['links']=[dict(mass_kg=float(a),com_m=[float(v) for v in b]) for a,b in zip(m0,c0)]
    yy['parameters']['estimate']='complete'
    yaml.safe_dump(yy, open(folder+'/true.yaml','w'))
    Pz = np.zeros(N) if meas=='distance' else np.zeros((N,3))
    if meas=='pose': write(Pz,np.tile([1,0,0,0],(N,1)).astype(float),q,folder,9)
    else: write(Pz,None,q,folder,9)
    c = Case(folder+'/true.yaml'); s = State(c); gi = {k:i for i,k in enumerate(c.G)}
    for i,g in enumerate(c.G):
        if g[0]=='th': s.g[i]=r.normal(0,5e-4)
        if g[0] in('al',): s.g[i]=r.normal(0,2e-4)
        if g[0] in('a','d'): s.g[i]=r.normal(0,2e-4)
    if est=='complete':
        for i,g in enumerate(c.G):
            if g[0]=='be': s.g[i]=r.normal(0,3e-4)
            if g[0] in('base','tool') : s.g[i]=r.normal(0,1e-3)
    geo_truth=[]
    if est=='tad' and r.random()<.3:
        which=ch(['base','tool','tilt'])
        for i,g in enumerate(c.G):
            if which=='base' and g[0]=='base': s.g[i]=r.normal(0,2e-3); 
            if which=='tool' and g[0]=='tool': s.g[i]=r.normal(0,2e-3)
            if which=='tilt' and g[0]=='be' : s.g[i]=r.normal(0,1e-3)
        geo_truth=[which]
    F=forward(c,s); Ld=loads(c,s,F,False); tau=Ld['tau']
    loaded=[j for j in range(n) if rev[j] and np.ptp(tau[:,j])>5]
    revs=[j for j in range(n) if rev[j]]
    truth=[]; E={}
    def add(k,w): E[k]=E.get(k,0)+w
    def comp(j,st): add(('th',j),(st*3e-6 if j<3 else st*30e-6)*tau[:,j]*r.choice([.7,1.,1.4])); truth.append(('joint_compliance',j+1))
    def gear(j,o,st): ph=r.uniform(0,2*np.pi); add(('th',j),st*1e-4*np.sin(o*q[:,j]/D+ph)); truth.append(('gear_harmonic',j+1))
    st=strength
    if kind in('compliance','two_compliances','comp_gear','comp_drift','bending','base_compliance','balancer','three') and not loaded: kind='gear'
    main=[j for j in loaded if j<4] or loaded
    if kind=='compliance': comp(ch(main),st)
    if kind=='two_compliances': js=r.permutation(main)[:2]; [comp(j,st*r.choice([.6,1,1.5])) for j in js]
    if kind=='gear': gear(ch(revs),int(r.integers(2,8)),st)
    if kind=='mesh': gear(ch(revs),float(np.round(r.uniform(15,150),1)),min(st,5))
    def back(j,st): add(('th',j),.5*st*1e-4*dirs[:,j]); truth.append(('backlash',j+1))
    if kind=='backlash': back(ch(revs),st)
    if kind=='coupling': j=ch(revs); i=ch([x for x in revs if x!=j]); add(('th',j),st*2e-4*q[:,i]/D); truth.append(('joint_coupling',j+1))
    if kind=='gain': j=ch(revs[1:]); add(('th',j),st*1e-4*q[:,j]/D); truth.append(('joint_gain',j+1))
    def drift(st):
        u=1-np.exp(-t/(t.max()*r.uniform(.08,.6))); v=r.normal(0,1,3); v/=np.linalg.norm(v)
        for k in range(3): add(('basew',k),st*1.5e-4*v[k]*u)
        truth.append(('base_drift',None))
    if kind=='base_drift': drift(st)
    if kind=='joint_drift': j=ch(revs[1:-1]); add(('th',j),st*1e-4*(1-np.exp(-t/(t.max()*r.uniform(.08,.6))))); truth.append(('joint_drift',j+1))
    if kind=='tool_step':
        w=(np.arange(N)>=int(r.uniform(.15,.85)*N))*1.; v=r.normal(0,1,3); v/=np.linalg.norm(v)
        for k in range(3): add(('tool',k),st*1e-4*v[k]*w)
        truth.append(('tool_step',None))
    if kind=='joint_step': j=ch(revs[1:-1]); add(('th',j),st*1e-4*(np.arange(N)>=int(r.uniform(.15,.85)*N))); truth.append(('joint_step',j+1))
    if kind=='wobble':
        j=ch(revs); ph=2*q[:,j]/D+r.uniform(0,6); add(('tilt',j,0),st*5e-5*np.cos(ph)); add(('tilt',j,1),st*5e-5*np.sin(ph)); truth.append(('axis_wobble',j+1))
    if kind=='balancer':
        j=1; p=r.uniform(0,6); rr=.2; add(('th',j),st*1.5e-4*np.sin(q[:,j]/D+p)/np.sqrt(1+rr-2*np.sqrt(rr)*np.cos(q[:,j]/D+p))); truth.append(('gravity_balancer',2))
    if kind=='bending':
        js=[j for j in Ld['bend'] if np.ptp(Ld['bend'][j][0])>0 and j>0]
        if js:
            j=ch(js)
            for k in range(6): add(('link',j,k),st*1e-6*Ld['bend'][j][0][:,k])
            truth.append(('link_bending',j+1))
        else: comp(ch(main),st)
    if kind=='base_compliance':
        for k in range(2): add(('sway',k),st*2e-7*Ld['M'][:,k]*r.choice([1,1.5]))
        truth.append(('base_compliance',None))
    if kind=='product': j=ch(revs[1:]); i,k=r.permutation([x for x in revs if x!=j])[:2]; add(('th',j),st*1e-4*(q[:,i]/D)*(q[:,k]/D)); truth.append(('unnamed',j+1))
    if kind=='comp_gear': comp(ch(main),st); gear(ch(revs),int(r.integers(2,8)),st)
    if kind=='comp_drift': comp(ch(main),st); drift(st)
    if kind=='backlash_gear': j=ch(revs); back(j,st); gear(ch([x for x in revs if x!=j]),int(r.integers(2,8)),st)
    if kind=='three':
        for j in r.permutation(main)[:2]: comp(j,st)
        back(ch(revs),st)
    P0=F['P']; s.E=E; F1=forward(c,s); P=F1['P']
    # visibility: signature beyond geometry
    SL=slots(c,F); ones=np.ones(N)
    from dh import geo_slot
    A=np.stack([ (geo_slot(c,g,SL)[:, :3]).reshape(-1) for g in c.G],1)
    sigv=(P-P0).reshape(-1); 
    if meas=='distance':
        Aa=np.array([y['measurement']['anchors'][a]['xyz_m'] for a in anc]); u=(P0-Aa); u/=np.linalg.norm(u,axis=1)[:,None]
        A=np.einsum('ni,nik->nk',u,A.reshape(N,3,-1)); sigv=((P-P0)*u).sum(1)
    nr=np.linalg.norm(A,axis=0); nr[nr==0]=1; U,S_,_=np.linalg.svd(A/nr,full_matrices=False); U=U[:,S_>1e-6*S_[0]]
    left=sigv-U@(U.T@sigv); 
    jq=10.0**-dec/D/np.sqrt(12)
    eff=np.hypot(sig, jq*.8)
    shows=np.sqrt((left**2).sum())/eff/np.sqrt(reps)
    # readings
    def noise(sh): 
        e=r.normal(0,1,sh)
        if tail=='t3': e=r.standard_t(3,sh)/np.sqrt(3)
        return e
    Rq=None
    prep = np.repeat(noise((npose,3)),reps,0)*sig if reps>1 else 0
    nz = (prep + .1*sig*noise((N,3))) if reps>1 else sig*noise((N,3))
    bad = r.random(N)<outl
    if meas=='distance':
        Z=np.linalg.norm(P-Aa,axis=1)+sig*noise(N); Z[bad]+=r.choice([-1,1],bad.sum())*np.exp(r.uniform(np.log(15),np.log(300),bad.sum()))*sig
    else:
        Z=P+nz; v=r.normal(0,1,(N,3)); v/=np.linalg.norm(v,axis=1)[:,None]; Z[bad]+=v[bad]*(np.exp(r.uniform(np.log(15),np.log(300),bad.sum()))*sig)[:,None]
    if meas=='pose':
        RR=exps(srot*noise((N,3)))@F1['TR']
        tr=np.trace(RR,axis1=1,axis2=2); w=np.sqrt(np.maximum(0,1+tr))/2
        from numpy.linalg import eigh
        qs=np.zeros((N,4))
        for k in range(N):
            M=RR[k]; K=np.array([[M[0,0]-M[1,1]-M[2,2],0,0,0],[M[0,1]+M[1,0],M[1,1]-M[0,0]-M[2,2],0,0],[M[0,2]+M[2,0],M[1,2]+M[2,1],M[2,2]-M[0,0]-M[1,1],0],[M[2,1]-M[1,2],M[0,2]-M[2,0],M[1,0]-M[0,1],M.trace()]])/3
            wv,V=np.linalg.eigh(K); x=V[:,3]; qs[k]=[x[3],x[0],x[1],x[2]]
        Rq=qs
    if kind in('backlash','backlash_gear','three') or r.random()<.3:
        for i in range(n): head.append(f'dir{i+1}'); cols.append([str(v) for v in dirs[:,i]])
    write(Z,Rq,q,folder,dec)
    yaml.safe_dump(y,open(folder+'/problem.yaml','w'))
    if kind=='null': truth=[]
    json.dump(dict(truth=[(a,None if b is None else int(b)) for a,b in truth],kind=kind,robot=name,meas=meas,est=est,strength=strength,given=given,mass=massmode,dec=dec,reps=reps,outl=outl,tail=tail,N=N,geo=geo_truth,shows=float(shows),sig=sig,rms=float(np.sqrt((left**2).mean()))),open(folder+'/truth.json','w'))
if __name__=='__main__':
    a,b,out=int(sys.argv[1]),int(sys.argv[2]),sys.argv[3]
    for sd in range(a,b):
        try: make(sd,f'{out}/c{sd}')
        except Exception as e: print(sd,type(e).__name__,e)
